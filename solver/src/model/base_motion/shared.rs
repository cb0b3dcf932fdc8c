//! What is too large to be copied and compared at every look: a reference that counts, read and written as what it holds.

use std::ops::Deref;
use std::sync::Arc;

use nanoserde::{DeBin, DeBinErr, SerBin};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A shared value. Two that share the same one are equal without being looked through.
#[derive(Debug, Clone, Default)]
pub struct Shared<T>(Arc<T>);

impl<T> Shared<T> {
    /// To be shared from now on.
    pub fn new(value: T) -> Self {
        Self(Arc::new(value))
    }
}

impl<T> Deref for Shared<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T: PartialEq> PartialEq for Shared<T> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || *self.0 == *other.0
    }
}

impl<T: Serialize> Serialize for Shared<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Shared<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        T::deserialize(deserializer).map(Self::new)
    }
}

impl<T: SerBin> SerBin for Shared<T> {
    fn ser_bin(&self, bytes: &mut Vec<u8>) {
        self.0.ser_bin(bytes);
    }
}

impl<T: DeBin> DeBin for Shared<T> {
    fn de_bin(offset: &mut usize, bytes: &[u8]) -> Result<Self, DeBinErr> {
        T::de_bin(offset, bytes).map(Self::new)
    }
}

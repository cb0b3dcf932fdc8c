//! Pieces of work and what they find. The two are paired by their types; only on the way to a worker, and in the book of
//! who does what, are they without them. Page and workers send them to each other in a plain binary form, which costs the
//! page a quarter of the code that JSON would.

use std::any::Any;
use std::hash::{DefaultHasher, Hasher};

use nanoserde::{DeBin, SerBin};

use crate::sentence::{Sentence, said};

/// Who is told the done part of a piece, 0 to 1, as it grows.
pub type Tell<'a> = &'a dyn Fn(f64);

/// A piece of work, done within a fraction of a second unless it says otherwise.
pub trait Piece: SerBin + DeBin + Send + Sync + 'static {
    /// Its name on the way to a worker.
    const NAME: &'static str;
    /// Whether it may take long.
    const LONG: bool = false;
    /// What it finds.
    type Found: SerBin + DeBin + Send + 'static;

    /// Does the work.
    ///
    /// # Errors
    /// What is out of range or cannot be computed.
    fn carry_out(&self) -> Result<Self::Found, Failure>;

    /// The same, telling how far it is, where the piece may take long.
    ///
    /// # Errors
    /// As [`Self::carry_out`].
    fn carry_out_telling(&self, _tell: Tell<'_>) -> Result<Self::Found, Failure> {
        self.carry_out()
    }
}

/// Why a piece found nothing.
pub type Failure = Sentence;

/// What was found, on its way back to whoever asked.
pub enum Finding {
    /// As it was found, on this side.
    Here(Box<dyn Any + Send>),
    /// As a worker sends it.
    Message(Vec<u8>),
}

impl Finding {
    /// What a piece found that finds an `F`.
    ///
    /// # Errors
    /// When the message is broken.
    pub fn open<F: DeBin + 'static>(self) -> Result<F, Failure> {
        match self {
            Self::Here(found) => found.downcast().map(|found| *found).map_err(|_| broken()),
            Self::Message(bytes) => F::deserialize_bin(&bytes).map_err(|_| broken()),
        }
    }
}

fn broken() -> Failure {
    said("the computation returned something else than asked for", &[])
}

/// A piece, whatever it finds.
pub trait Work: Any + Send + Sync {
    /// Does the work on this side.
    ///
    /// # Errors
    /// As [`Piece::carry_out`].
    fn carry_out(&self) -> Result<Finding, Failure>;
    /// The piece as bytes, to be read by a [`Hand`] of its name.
    fn message(&self) -> Vec<u8>;
    /// Its name.
    fn name(&self) -> &'static str;
    /// Whether it may take long.
    fn is_long(&self) -> bool;
}

impl<P: Piece> Work for P {
    fn carry_out(&self) -> Result<Finding, Failure> {
        Ok(Finding::Here(Box::new(Piece::carry_out(self)?)))
    }

    fn message(&self) -> Vec<u8> {
        self.serialize_bin()
    }

    fn name(&self) -> &'static str {
        P::NAME
    }

    fn is_long(&self) -> bool {
        P::LONG
    }
}

/// What a worker does with a message about a piece of this name.
#[derive(Debug, Clone, Copy)]
pub struct Hand {
    /// The piece's name.
    pub name: &'static str,
    /// Reads the piece, carries it out, telling how far it is, and writes what was found.
    pub carry_out: fn(&[u8], Tell<'_>) -> Result<Vec<u8>, Failure>,
}

impl Hand {
    /// The hand for pieces of the type `P`.
    pub const fn of<P: Piece>() -> Self {
        Self {
            name: P::NAME,
            carry_out: |message, tell| {
                let piece = P::deserialize_bin(message).map_err(|_| broken())?;
                Ok(piece.carry_out_telling(tell)?.serialize_bin())
            },
        }
    }
}

/// A number that is another one for other data, all of it, floats by their bits.
pub fn fingerprint(data: &impl SerBin) -> u64 {
    let mut hasher = DefaultHasher::new();
    hasher.write(&data.serialize_bin());
    hasher.finish()
}

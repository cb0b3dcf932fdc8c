//! The lessons by name.

use std::fmt;
use std::sync::{OnceLock, RwLock};

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use super::data::Lesson;

/// Steps that a lesson may have.
pub const STEPS: usize = 12;

/// Names and texts of the lessons, in the order in which they are offered.
const SOURCES: [(&str, &str); 13] = [
    ("tour", include_str!("../../../assets/lessons/tour.json")),
    ("resonance", include_str!("../../../assets/lessons/resonance.json")),
    ("quadratic", include_str!("../../../assets/lessons/quadratic.json")),
    ("first-tongue", include_str!("../../../assets/lessons/first-tongue.json")),
    ("period-doubling", include_str!("../../../assets/lessons/period-doubling.json")),
    ("torus", include_str!("../../../assets/lessons/torus.json")),
    ("difference", include_str!("../../../assets/lessons/difference.json")),
    ("boundaries", include_str!("../../../assets/lessons/boundaries.json")),
    ("basins", include_str!("../../../assets/lessons/basins.json")),
    ("escape", include_str!("../../../assets/lessons/escape.json")),
    ("harvest", include_str!("../../../assets/lessons/harvest.json")),
    ("chirp", include_str!("../../../assets/lessons/chirp.json")),
    ("random", include_str!("../../../assets/lessons/random.json")),
];

/// The name of the lesson of one's own, and that lesson, once a file has brought one.
const OWN: &str = "own";
static BROUGHT: RwLock<Option<&'static Lesson>> = RwLock::new(None);

/// A lesson by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct LessonId(usize);

impl LessonId {
    /// All of them, in the order in which they are offered.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..SOURCES.len()).map(Self)
    }

    /// The first minute.
    pub fn tour() -> Self {
        Self(0)
    }

    /// The lesson that a file has brought.
    pub fn own() -> Self {
        Self(SOURCES.len())
    }

    /// Makes `lesson` the one that a file has brought.
    pub fn bring(lesson: Lesson) -> Self {
        // It is looked at from everywhere, as ours are; a page brings a few at most.
        let lesson: &'static Lesson = Box::leak(Box::new(lesson));
        if let Ok(mut brought) = BROUGHT.write() {
            *brought = Some(lesson);
        }
        Self::own()
    }

    /// The lesson of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().chain([Self::own()]).find(|id| id.name() == name)
    }

    /// Its name, as in links.
    pub fn name(self) -> &'static str {
        SOURCES.get(self.0).map_or(OWN, |(name, _)| name)
    }

    /// Its place in the list, from 1.
    pub fn number(self) -> usize {
        self.0 + 1
    }

    /// The file it is read from; nothing for one that is brought.
    pub fn source(self) -> &'static str {
        SOURCES.get(self.0).map_or("", |(_, source)| source)
    }

    /// What it says; `None` when its file is no lesson, which a test rules out, or none has been brought.
    pub fn lesson(self) -> Option<&'static Lesson> {
        if self == Self::own() {
            return BROUGHT.read().ok().and_then(|brought| *brought);
        }
        static LESSONS: OnceLock<Vec<Option<Lesson>>> = OnceLock::new();
        let read = || Self::all().map(|id| Lesson::read(id.source()).ok()).collect();
        LESSONS.get_or_init(read).get(self.0)?.as_ref()
    }
}

impl Serialize for LessonId {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for LessonId {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        Self::named(&name).ok_or_else(|| {
            static NAMES: OnceLock<Vec<&str>> = OnceLock::new();
            de::Error::unknown_variant(&name, NAMES.get_or_init(|| Self::all().map(Self::name).collect()))
        })
    }
}

impl fmt::Display for LessonId {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

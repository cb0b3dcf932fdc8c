//! What is fixed about a number of the model, and the one place where a number is declared: its row.

/// What is fixed about a number; all that lists numbers walks these.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fact {
    /// Its name in requests, files, links and error messages.
    pub field: &'static str,
    /// Its symbol in the paper; what follows an underscore is an index.
    pub symbol: &'static str,
    /// Its name beside others of its part.
    pub name: &'static str,
    /// Its name where it stands alone, as at an axis.
    pub title: &'static str,
    /// What it is, in a sentence.
    pub explanation: &'static str,
    /// Its unit as machines read it, in SI; empty when dimensionless. Where the unit depends on the electrical scaling both
    /// stand here, `as printed or consistent` (see [`super::ElectricalScaling::unit`]).
    pub unit: &'static str,
    /// The same with a blank before it, to stand behind a number.
    pub suffix: &'static str,
    /// The unit that people read, and how many of it are one in SI.
    pub shown: (&'static str, f64),
    /// Smallest and largest accepted value, in SI.
    pub range: (f64, f64),
    /// Smallest and largest value a slider should offer, in SI; wider ones may be accepted.
    pub usual: (f64, f64),
    /// How it spreads over a slider.
    pub scale: Scale,
    /// What it is a number of.
    pub part: Part,
    /// Its place among the sliders of its part: the lower ones come first, equal ones in the order of their rows.
    pub order: i8,
}

/// How values spread.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scale {
    /// Evenly.
    Linear,
    /// By ratio.
    Logarithmic,
    /// By ratio from this value (in SI) on, with zero below it.
    LogarithmicFrom(f64),
}

/// What a number belongs to; those of one part stand together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// What is changed most: excitation and damping.
    Main,
    /// The magnets.
    Magnets,
    /// The beam with its tip mass.
    Beam,
    /// The circuit.
    Circuit,
    /// The ceramic.
    Ceramic,
}

impl Fact {
    /// Where a row says nothing else.
    pub(super) const PLAIN: Self = Self {
        field: "",
        symbol: "",
        name: "",
        title: "",
        explanation: "",
        unit: "",
        suffix: "",
        shown: ("", 1.0),
        range: (0.0, 0.0),
        usual: (0.0, 0.0),
        scale: Scale::Linear,
        part: Part::Main,
        order: 0,
    };

    /// The usual values are all that are accepted where a row says nothing else.
    pub(super) const fn completed(self) -> Self {
        let says_nothing = self.usual.0 == 0.0 && self.usual.1 == 0.0;
        if says_nothing { Self { usual: self.range, ..self } } else { self }
    }

    /// Its symbol without an index.
    pub fn base(&self) -> &'static str {
        self.symbol.split('_').next().unwrap_or_default()
    }
}

/// Declares a set of numbers, a type that names each of them, and what is fixed about them, by a row each: variant,
/// field, unit, value in the paper, explanation, and the entries of its [`Fact`] that are not plain. What else stands in
/// the set follows a row behind `+`.
macro_rules! numbers {
    (
        $(#[$($about_set:tt)*])*
        set $Set:ident,
        $(#[$($about_which:tt)*])*
        named by $Which:ident
        $(
            $(#[$($attribute:tt)*])*
            $Variant:ident $field:ident [$unit:literal] = $value:expr, $explanation:literal {
                $($entry:ident: $fact:expr),* $(,)?
            }
            $(
                + $(#[$($about:tt)*])* $other:ident: $Kind:ident $(<$Held:ident>)? = $usual:expr;
            )*
        )*
    ) => {
        $(#[$($about_set)*])*
        #[derive(
            Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize, nanoserde::SerBin, nanoserde::DeBin,
        )]
        #[serde(default, deny_unknown_fields)]
        pub struct $Set {
            $(
                #[doc = concat!($explanation, " \\[", $unit, "\\]")]
                $(#[$($attribute)*])*
                pub $field: f64,
                $($(#[$($about)*])* pub $other: $Kind $(<$Held>)?,)*
            )*
        }

        $(#[$($about_which)*])*
        #[derive(
            Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize, nanoserde::SerBin,
            nanoserde::DeBin,
        )]
        #[serde(rename_all = "snake_case")]
        pub enum $Which {
            $(#[doc = $explanation] $Variant,)*
        }

        impl $Set {
            /// Every number with the value that its row gives.
            const PRINTED: Self = Self { $($field: $value, $($other: $usual,)*)* };

            /// The value of a number, in SI.
            pub const fn get(&self, which: $Which) -> f64 {
                match which {
                    $($Which::$Variant => self.$field,)*
                }
            }

            /// The place of a number, to write to.
            pub const fn get_mut(&mut self, which: $Which) -> &mut f64 {
                match which {
                    $($Which::$Variant => &mut self.$field,)*
                }
            }
        }

        impl $Which {
            /// All of them, in the order of their rows.
            pub const ALL: [Self; [$(stringify!($field)),*].len()] = [$(Self::$Variant),*];

            #[allow(clippy::needless_update, reason = "a row may give every entry")]
            const FACTS: &'static [Fact; Self::ALL.len()] = &[$(
                Fact {
                    field: stringify!($field),
                    unit: $unit,
                    suffix: if $unit.is_empty() { "" } else { concat!(" ", $unit) },
                    explanation: $explanation,
                    $($entry: $fact,)*
                    ..Fact::PLAIN
                }.completed(),
            )*];

            /// What is fixed about it.
            pub const fn fact(self) -> &'static Fact {
                &Self::FACTS[self as usize]
            }

            /// Its name in requests, files, links and error messages.
            pub const fn field(self) -> &'static str {
                self.fact().field
            }

            /// Smallest and largest accepted value, in SI.
            pub const fn range(self) -> (f64, f64) {
                self.fact().range
            }

            /// The one of this field name.
            pub fn named(field: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|which| which.field() == field)
            }

            /// Those of these parts, in the order of their sliders.
            pub fn of(parts: &[Part]) -> Vec<Self> {
                let of_part = |part: &Part| {
                    let mut found = Self::ALL.to_vec();
                    found.retain(|which| which.fact().part == *part);
                    found.sort_by_key(|which| which.fact().order);
                    found
                };
                parts.iter().flat_map(of_part).collect()
            }
        }
    };
}

pub(super) use numbers;

//! What words on the page mean: a plain sentence, and the equation where there is one.
//!
//! A word is looked up as it is shown, in whatever language, so that a legend or a title need not say which it is.

use super::{marked, tr};

/// A word with its meaning.
pub struct Term {
    /// Texts of the page that say it.
    pub words: &'static [&'static str],
    /// What it means.
    pub sentence: &'static str,
    /// Its equations in the paper's symbols, a line each.
    pub equation: &'static str,
}

const fn term(words: &'static [&'static str], sentence: &'static str, equation: &'static str) -> Term {
    Term { words, sentence, equation }
}

/// All of them. Where a text holds several words, those that stand first here are told first.
const TERMS: [Term; 30] = [
    term(
        &["published", "published boundary", "as printed (thin)"],
        marked(
            "The paper's boundary, to first order and without the circuit: above it the motion with the period of the shaking is unstable.",
        ),
        "Eq. 57, ω = ω₁+ω₂+σ₀:  |σ₀| = (η₂₁m₂ + η₂₂m₁)/(2η₂₁η₂₂) · √(G²/(ω₁ω₂m₁m₂) − α²)\n\
         Eq. 72, ω = 2ω₁+σ₁:  σ₁²ω₁²η₂₁² = G² − α²ω₁²m₁²\n\
         Eq. 81, ω = 2ω₂+σ₂:  σ₂²ω₂²η₂₂² = G² − α²ω₂²m₂²\n\
         G = c₂(a₁ + a₂),  mₖ = ωₖ²η₂ₖ − c₁,  Eq. 43:  aₖ = ω²βη₁ₖ/(η₂ₖ(ωₖ² − ω²))",
    ),
    term(
        &["coupled modes", "coupled-mode boundary", "coupled modes (thick)"],
        marked("The same theory with the circuit kept, which stiffens and damps the modes."),
        "",
    ),
    term(
        &["Floquet, this force law", "Floquet boundary"],
        marked(
            "Where a small disturbance of the motion begins to grow from period to period, computed from this very model.",
        ),
        "|μ| = 1",
    ),
    term(
        &["computed"],
        marked("The motion from the start in view, integrated step by step."),
        "Eq. 32:  η₂ₖ(d²qₖ/dt² + αωₖ²dqₖ/dt + ωₖ²qₖ) = αc₁ ∑dqₙ/dt − R(s) − θₖv + ω²βη₁ₖ sin ωt\n\
         Eq. 31:  c dv/dt + κv = ∑θₙ dqₙ/dt",
    ),
    term(
        &["first-order theory"],
        marked("The paper's formula for the steady motion, good while it is small."),
        "Eq. 59:  v = ω(a₁θ₁ + a₂θ₂)/√(κ² + c²ω²) · sin(ωt + atan(κ/(cω)))",
    ),
    term(
        &["last quarter", "at phase 0"],
        marked("Points taken once a period of the shaking, at the same phase."),
        "t = 2πk/ω",
    ),
    term(
        &[
            "Stability map",
            "Stability near 2ω₁",
            "Stability near ω₁+ω₂",
            "Stability near 2ω₂",
            "Stability chart",
        ],
        marked(
            "Frequency across, strength of shaking up. In a tongue the motion with the period of the shaking cannot last: it doubles, or two modes join.",
        ),
        "",
    ),
    term(
        &["Phase portrait", "Live phase portrait"],
        marked("Voltage across, how fast it changes up: a motion that repeats is a closed loop."),
        "",
    ),
    term(
        &["Poincaré map"],
        marked(
            "One point a period of the shaking: a single point is period 1, two are period 2, a ring is a torus, a cloud is chaos.",
        ),
        "t = 2πk/ω",
    ),
    term(&["Time history", "Oscilloscope"], marked("The voltage over time."), ""),
    term(
        &["Floquet multipliers"],
        marked(
            "By what factor disturbances grow in a period, as complex numbers: all inside of the circle means stable.",
        ),
        "|μ| < 1",
    ),
    term(
        &["Bifurcation curves"],
        marked("Where the motion changes its kind, in the plane of two numbers."),
        "",
    ),
    term(
        &["Basins of attraction"],
        marked("Each place is a start, its colour the motion that it leads to."),
        "",
    ),
    term(&["Spectrum"], marked("Of which frequencies the voltage is made."), ""),
    term(
        &["Orbit diagram"],
        marked(
            "The points of the Poincaré map while one number is swept up and down: one line is period 1, two are period 2.",
        ),
        "",
    ),
    term(
        &["Response curves"],
        marked("How large the motions are over one number, also those that are unstable and cannot be seen."),
        "",
    ),
    term(&["Over frequency"], marked("What the device delivers at each frequency of the shaking."), ""),
    term(&["Over the load"], marked("What the device delivers into each resistance."), ""),
    term(
        &["The magnets' force"],
        marked("The force between the magnets over the displacement of the tip, as each law has it."),
        "Eq. 16:  F(s₀) − F(s₀ + s) = c₁s + c₂s² + …",
    ),
    term(&["Period 1"], marked("The beam swings once for every shake."), ""),
    term(
        &["period doubling"],
        marked(
            "The motion takes on twice the period: a disturbance changes its sign in every period while it grows.",
        ),
        "μ = −1",
    ),
    term(
        &["Neimark–Sacker", "Neimark–Sacker (torus)"],
        marked("A second rhythm sets in beside that of the shaking."),
        "μ = exp(± iφ)",
    ),
    term(
        &["torus", "Quasiperiodic: a torus", "quasiperiodic"],
        marked(
            "Two rhythms that do not fit into each other: the motion winds around a torus and never quite repeats.",
        ),
        "",
    ),
    term(
        &["fold"],
        marked("Two motions, one stable and one not, meet and vanish: the beam jumps to another."),
        "μ = 1",
    ),
    term(
        &["Chaotic", "chaotic"],
        marked("Starts that differ a little part exponentially, and yet the motion stays bounded."),
        "",
    ),
    term(&["escape"], marked("The truncated force lets the tip go for good; the exact one does not."), ""),
    term(&["contact"], marked("The magnets touch, where the model ends."), ""),
    term(
        &["V rms"],
        marked(
            "The root of the mean square: what a constant voltage would have to be to heat the load as much.",
        ),
        "P = V²/R",
    ),
    term(&["unstable"], marked("Small disturbances grow: the motion exists, but is not seen."), ""),
    term(&["stable"], marked("Small disturbances die out."), ""),
];

/// The meaning of a text that is one of the words.
pub fn meaning(text: &str) -> Option<&'static Term> {
    TERMS.iter().find(|term| term.words.iter().any(|word| tr(word) == text))
}

/// The meanings of the words in a text, at most `most` of them.
pub fn within(text: &str, most: usize) -> Vec<(&'static str, &'static Term)> {
    let lower = text.to_lowercase();
    let words = TERMS.iter().flat_map(|term| term.words.iter().map(move |word| (tr(word), term)));
    let mut found: Vec<(&'static str, &'static Term)> = Vec::new();
    for (word, term) in words {
        let small = word.to_lowercase();
        let new = |(before, other): &(&str, &Term)| {
            !std::ptr::eq(*other, term) && !before.to_lowercase().contains(&small)
        };
        if found.len() < most && found.iter().all(new) && lower.contains(&small) {
            found.push((word, term));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_those_of_the_page_and_no_two_terms_share_one() {
        let page = include_str!("../../../assets/text/de.json");
        let mut seen = std::collections::BTreeSet::new();
        for word in TERMS.iter().flat_map(|term| term.words) {
            assert!(page.contains(&format!("\"{word}\":")), "{word} is said nowhere");
            assert!(seen.insert(word), "{word} twice");
        }
    }

    #[test]
    fn a_text_is_explained_by_the_words_in_it() {
        assert!(meaning("published").is_some_and(|term| term.equation.contains("Eq. 57")));
        assert!(meaning("something else").is_none());
        let found = within("period 2; the forced motion is unstable: period doubling, 7.55 V rms", 3);
        let words: Vec<&str> = found.iter().map(|(word, _)| *word).collect();
        assert_eq!(words, ["period doubling", "V rms", "unstable"]);
    }
}

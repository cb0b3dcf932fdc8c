//! What the core says in English, in the reader's language.
//!
//! The core knows no languages: its sentences stand in the JSON of the native command and come from workers as texts.
//! Here each is known by the words between its values. One that is not known stays English.

use super::{fill_with, is_english, marked, tr};
use crate::dynamics::attractors::motion::Motion;

/// The sentences, the more special before the more general. A value may be another sentence.
const SENTENCES: [&str; 133] = [
    // Motions.
    marked("a start on the stable forced motion leads to another motion: {motion}, {volts} V rms"),
    marked("a start at rest leads to another motion: {motion}, {volts} V rms"),
    marked("a start that differs by rounding leads to another motion: {motion}, {volts} V rms"),
    marked("a start on a motion met on the way leads to another motion: {motion}, {volts} V rms"),
    marked("starts that differ by rounding: {ends}"),
    marked("{count} × {motion}, {volts} V rms"),
    marked("{count} × {motion}"),
    marked(
        "period {periods} stable, largest modulus {modulus}; the run ends {distance} of the amplitude from it",
    ),
    marked(
        "period {periods} unstable, largest modulus {modulus}; the run ends {distance} of the amplitude from it",
    ),
    marked("period {periods}"),
    marked("quasiperiodic"),
    marked("chaotic"),
    marked("escape at t = {time}"),
    marked("contact at t = {time}"),
    marked("undecided: {why}"),
    marked("undecided"),
    marked("the transient has not gone: the run ends {percent} % of the amplitude away"),
    marked("the transient has not gone"),
    marked("the run is still near an unstable periodic motion"),
    marked("the Lyapunov exponent has not converged"),
    marked("the exponent is zero, but the stroboscopic points lie on no closed curves"),
    marked("the motion is too fast to differentiate"),
    marked("the evidence disagrees"),
    marked("it moves chaotically, but may still settle"),
    marked("the outcome depends on rounding"),
    // Warnings.
    marked("neighbouring motions diverge until it settles, at t = {time}"),
    marked("to decide would take about {time} more in t"),
    marked(
        "the magnet force beyond its linear part is {percent} % too weak at the closest approach under this force law",
    ),
    marked(
        "the magnet force beyond its linear part is {percent} % too strong at the closest approach under this force law",
    ),
    marked("the tip passes through the magnet: only the exact force law knows of contact"),
    marked("the tip moves by {part} of the beam's length, where the beam is no linear one"),
    marked("the escape is over the barrier of the truncated force law; the exact one has none"),
    marked("the motion that grows from rest with beta can be followed to beta = {beta} only"),
    marked("the forced motion could not be computed"),
    // Evidence.
    marked("{text}: a multiple of {periods}, as they spiral in"),
    marked("{text}, still settling"),
    marked("stroboscopic points repeat after 1 period to {part}"),
    marked("stroboscopic points repeat after {periods} periods to {part}"),
    marked("stroboscopic points do not repeat within 8 periods (off by {part})"),
    marked("stroboscopic points lie on closed curves: dimension {dimension}"),
    marked("stroboscopic points fill a surface: dimension {dimension}"),
    marked("stroboscopic points are scattered: dimension {dimension}"),
    marked("rotation number {number}, the halves of the record differ by {error}"),
    marked("0-1 test {value}: 0 is regular, 1 chaotic"),
    marked("{text}; by the multipliers {value}"),
    marked("exponent {value}: zero"),
    marked("exponent {value}, not converged"),
    marked("exponent {value}"),
    marked("no voltage"),
    marked("{percent} % of its power between the lines"),
    marked("{line} at {volts} V"),
    // Points where curves of bifurcations meet.
    marked("cusp"),
    marked("{ratio} resonance"),
    marked("fold-flip"),
    marked("fold-Neimark-Sacker"),
    marked("flip-Neimark-Sacker"),
    marked("double Neimark-Sacker"),
    marked("generalized period doubling"),
    marked("Chenciner"),
    // What is wrong with a device.
    marked(
        "the magnets attract so strongly that the tip has no equilibrium (pull-in): with c0 = {c0} and h = {h} the gap d = {d} must be larger than {smallest}",
    ),
    marked(
        "the magnet softens the beam past buckling: c1 = {c1} must be greater than -3, the stiffness of the beam's tip",
    ),
    marked("under gravity the tip sags {sag} m, which closes the magnets' distance of {distance} m"),
    marked("{field} = {value} is out of range: allowed are {from} to {to}"),
    marked("{field} is not a finite number: allowed are {from} to {to}"),
    marked("both sides of the chart are {field}: they must differ"),
    // Why something could not be computed.
    marked(
        "omega = {omega} is the natural frequency of mode {mode}: the first-order theory has no steady state there",
    ),
    marked(
        "omega = {omega} is an undamped eigenfrequency of beam and circuit: there is no linear steady state",
    ),
    marked("the resonance theories need at least two modes, the system has {found}"),
    marked(
        "only {found} of the coupled modes oscillate lightly damped (decay slower than they turn): the coupled-mode theory needs two",
    ),
    marked("the eigenvalues of the linear system were not found within {iterations} iterations"),
    marked("the coefficients of the linear system are not finite numbers"),
    marked("the motion escapes at time {time}"),
    marked("the magnets touch at time {time}"),
    marked("{steps} steps a period are too few to follow the motion"),
    marked(
        "no periodic motion found near the guess: after {iterations} iterations the state still misses itself by {residual} of the gap",
    ),
    marked("the periodic motion cannot be isolated: one of its multipliers is 1"),
    marked("the multipliers did not converge"),
    marked("without any damping there is no onset of a modulation"),
    marked("the curve bends too sharply to be followed"),
    marked("the forced motion ends below beta = {beta}"),
    marked("the plane's range of {parameter} must grow, and its two parameters must differ"),
    marked("initial must be {expected} finite numbers (q1..qN, dq1/dt..dqN/dt, v), got {got}"),
    marked(
        "the step became too small at time {time}: the motion cannot be resolved to tolerance {tolerance}",
    ),
    marked(
        "the motion is too fast to follow: {steps} steps have reached time {time} only; start nearer to rest, reduce beta or use the exact force law",
    ),
    marked("the motion ends within the record of the spectrum"),
    // What is wrong with a file or a link.
    marked("the file is empty"),
    marked("no row with at least two numbers in the first {lines} lines; line 1 is \"{first}\""),
    marked("line {line} has {fields} fields, column {column} is missing: \"{content}\""),
    marked("line {line}, column {column}: \"{content}\" is not a finite number"),
    marked("line {line} cannot be read: {problem}"),
    marked("{field} = {value} is not available: {allowed}"),
    marked("not a number; {allowed}"),
    marked("allowed are whole numbers from {from} to {to}"),
    marked("allowed are quadratic, taylor2 to taylor{degree} and exact"),
    marked("allowed are {from} to {to} ohm, or open"),
    marked("allowed are {from} to {to} periods a second"),
    marked("allowed are {from} to {to}"),
    marked("allowed are true and false"),
    marked("allowed are finite numbers other than 0"),
    marked("allowed is {word}"),
    marked("needs {count} numbers"),
    marked("plane: two different ones of {names}"),
    marked("numbers in initial"),
    marked("an array of length {count}"),
    marked("allowed are {one} or {other}"),
    marked("allowed are {words}"),
    marked("not valid JSON: {problem}"),
    marked("not a name this page knows"),
    marked("this page knows version {version}"),
    marked("it is UTF-16 text: save it as UTF-8"),
    marked("it is no text: byte {place} is no character of one"),
    marked("it is larger than {megabytes} MB"),
    marked("line {line} is longer than {characters} characters"),
    marked("it ends too early ({place})"),
    marked("{path} is given twice"),
    marked(
        "{path}: a text of {length} characters stands where names and words are, which have at most {most}",
    ),
    // The page's own.
    marked("There is no curve for this device."),
    // What is wrong with an entry: after all others, because a place may hold anything.
    marked("{field}: {problem}"),
    marked("{count} values stand where {needed} is needed"),
    marked("{given} stands where {needed} is needed"),
    marked("unknown field {name}: known are {names}"),
    marked("unknown field {name}: none is known here"),
    marked("{name} is not available: allowed are {names}"),
    marked("{name} is missing"),
    marked("a number"),
    marked("a whole number of at least 0"),
    marked("a whole number"),
    marked("a list of {count} values"),
    marked("a list"),
    marked("true or false"),
    marked("a text in quotation marks"),
    marked("an object in braces"),
    marked("one of the names known here"),
];

/// The class of a motion.
pub fn motion_in_words(motion: Motion) -> String {
    reworded(&motion.to_string())
}

/// A sentence of the core in the reader's language, or as it is.
pub fn reworded(english: &str) -> String {
    if is_english() {
        return english.to_owned();
    }
    for sentence in SENTENCES {
        if let Some(values) = values_in(sentence, english) {
            return fill_with(tr(sentence), values.iter().map(|(name, value)| (*name, reworded(value))));
        }
    }
    english.to_owned()
}

/// The values of a sentence by their names, if `text` is that sentence.
fn values_in<'a>(sentence: &'static str, text: &'a str) -> Option<Vec<(&'static str, &'a str)>> {
    let mut values = Vec::new();
    let (head, mut ahead) = sentence.split_once('{').unwrap_or((sentence, ""));
    let mut rest = text.strip_prefix(head)?;
    while let Some((name, after)) = ahead.split_once('}') {
        let (words, next) = after.split_once('{').unwrap_or((after, ""));
        let value;
        (value, rest) =
            if next.is_empty() { (rest.strip_suffix(words)?, "") } else { rest.split_once(words)? };
        values.push((name, value));
        ahead = next;
    }
    rest.is_empty().then_some(values)
}

#[cfg(test)]
mod tests;

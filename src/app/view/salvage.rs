//! What of a stored state can be kept when parts of it are bad.

use serde_json::Value;

use crate::sentence::Sentence;

/// Most parts that are dropped before all is given up.
const MOST: usize = 64;

/// Reads `value`, less the smallest parts without which it can be read, and the paths of these. `read` refuses what is
/// bad for a reason; what is as bad without a part is not mended by dropping it.
///
/// # Errors
/// The first reason, when no part can be blamed.
pub(super) fn salvage<T>(
    mut value: Value,
    read: impl Fn(Value) -> Result<T, Sentence>,
) -> Result<(T, Vec<String>), Sentence> {
    let mut dropped = Vec::new();
    let mut first = None;
    loop {
        let reason = match read(value.clone()) {
            Ok(found) => return Ok((found, dropped)),
            Err(reason) => reason,
        };
        let first = first.get_or_insert_with(|| reason.clone());
        // What mends all of it, or else what mends this and leaves another fault, but does not make one where it stood.
        let mut helps = None;
        let mends = |place: &String| match read(without(&value, place)) {
            Ok(_) => true,
            Err(left) => {
                let holder = dotted(place.rsplit_once('/').map_or("", |(holder, _)| holder));
                if left != reason
                    && (holder.is_empty() || !left.to_string().starts_with(&holder))
                    && helps.is_none()
                {
                    helps = Some(place.clone());
                }
                false
            }
        };
        // The smaller parts come before what holds them.
        let whole = places(&value).into_iter().find(mends);
        let Some(place) = whole.or(helps).filter(|_| dropped.len() < MOST) else { return Err(first.clone()) };
        value = without(&value, &place);
        dropped.push(dotted(&place));
    }
}

/// Pointers to the entries of all objects in `value`, innermost first.
fn places(value: &Value) -> Vec<String> {
    let mut found = Vec::new();
    gather(value, "", &mut found);
    found.sort_by_key(|place| std::cmp::Reverse(place.matches('/').count()));
    found
}

fn gather(value: &Value, parent: &str, found: &mut Vec<String>) {
    let Value::Object(entries) = value else { return };
    for (name, entry) in entries {
        let place = format!("{parent}/{}", name.replace('~', "~0").replace('/', "~1"));
        gather(entry, &place, found);
        found.push(place);
    }
}

/// The path of a pointer as messages write it.
fn dotted(pointer: &str) -> String {
    pointer.trim_start_matches('/').replace('/', ".")
}

fn without(value: &Value, place: &str) -> Value {
    let mut rest = value.clone();
    let parent = place.rsplit_once('/').and_then(|(parent, name)| Some((rest.pointer_mut(parent)?, name)));
    if let Some((Value::Object(entries), name)) = parent {
        entries.remove(&name.replace("~1", "/").replace("~0", "~"));
    }
    rest
}

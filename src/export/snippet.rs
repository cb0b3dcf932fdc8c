//! A question as a short program.

/// A Rust program that asks the solver what `request` (JSON) asks, and prints the answer.
pub fn rust(request: &str) -> String {
    // A raw string ends where as many signs follow a quote; one more than in any text of the request are enough.
    let mut signs = "#".to_owned();
    while request.contains(&format!("\"{signs}")) {
        signs.push('#');
    }
    format!(
        "// Asks Harvester Lab what its page showed. Cargo.toml:
//
// [dependencies]
// harvester-lab = {{ path = \"harvester-lab\" }}

use harvester_lab::questions::solve;

const REQUEST: &str = r{signs}\"{request}\"{signs};

fn main() -> Result<(), String> {{
    let answer = solve(REQUEST)?;
    println!(\"{{answer}}\");
    Ok(())
}}
"
    )
}

/// The same in Python, by the native command.
pub fn python(request: &str) -> String {
    format!(
        "\"\"\"Asks Harvester Lab what its page showed; needs its command `harvester` on the path.\"\"\"

import json
import subprocess

REQUEST = r'''{request}'''

done = subprocess.run([\"harvester\"], input=REQUEST, stdout=subprocess.PIPE, text=True, check=True)
answer = json.loads(done.stdout)
print(json.dumps(answer, indent=2))
"
    )
}

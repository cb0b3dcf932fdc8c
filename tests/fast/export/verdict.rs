// Asks Harvester Lab what its page showed. Cargo.toml:
//
// [dependencies]
// harvester-lab = { path = "harvester-lab" }

use harvester_lab::questions::solve;

const REQUEST: &str = r#"{"task":"verdict",
 "parameters":{"alpha":1e-4,"beta":0.01,"omega":8.0969},
 "t_end":300}"#;

fn main() -> Result<(), String> {
    let answer = solve(REQUEST)?;
    println!("{answer}");
    Ok(())
}

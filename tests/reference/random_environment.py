"""Does the paper's device work in a random environment (section 5.3)? Mean power under Gaussian noise over that of the same
device without magnets, with its standard error; the table in docs/equations.md.

Run in the project: cargo build --release --bin harvester; python3 tests/reference/random_environment.py
"""

import json
import subprocess

BANDS = {"0.4 to 9 Hz": (0.4, 9), "1.1 to 1.7 Hz": (1.1, 1.7), "2.5 to 3.2 Hz": (2.5, 3.2), "8.4 to 9.4 Hz": (8.4, 9.4)}
LEVELS = [0.002, 0.005, 0.02, 0.08, 0.2]
LAWS = ["quadratic", "exact"]


def request(band, law, rms):
    low, high = band
    noise = {"kind": "noise", "from": low, "to": high, "rms": rms, "duration": 600, "seed": 1}
    return {"task": "shake", "model": {"force": law}, "points": 2, "realisations": 16, "excitation": noise}


cases = [(name, law, rms) for name in BANDS for law in LAWS for rms in LEVELS]
lines = "".join(json.dumps(request(BANDS[name], law, rms)) + "\n" for name, law, rms in cases)
command = ["target/release/harvester", "--batch"]
answers = subprocess.run(command, input=lines, capture_output=True, text=True, check=True).stdout.splitlines()
for (name, law, rms), line in zip(cases, answers):
    found = json.loads(line)
    if found["gain"] is None:
        result = f"{found['outcome']}, {found['completed']} of 16 completed"
    else:
        result = f"{found['gain']:.3f} +- {found['gain_error']:.3f}, {found['completed']} of 16 completed"
    print(f"{name:14} {law:9} {rms:5} g  {result}")

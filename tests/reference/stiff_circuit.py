#!/usr/bin/env python3
"""Reference value for the test of a circuit far faster than the beam in tests/fast/integration.rs: the exact force law
with c = 1e-9, kappa = theta = 1e-2 (kappa / c = 1e7), alpha = 1e-4, beta = 1e-2, omega = 8, from rest to t = 20 by
SciPy's implicit Radau method, at three tolerances.

    python3 tests/reference/stiff_circuit.py      (a few minutes; needs NumPy and SciPy)
"""

import numpy as np
from scipy.integrate import solve_ivp

import figures

SCALE = 1e-2 / figures.THETA
figures.C, figures.KAPPA = 1e-9, 1e-2
for mode in figures.MODES:
    mode.theta *= SCALE
system = figures.System(1e-4, 1e-2, 8.0, rest=figures.rest_exact)


def jacobian(t, y):
    """By differences, but for the circuit, which dominates it and is linear."""
    base = system.derivative(t, np.append(y, 0.0))[:-1]
    steps = np.array([1e-7, 1e-7, 1e-6, 1e-6, 1e-3])
    columns = [(system.derivative(t, np.append(y + step * unit, 0.0))[:-1] - base) / step
               for step, unit in zip(steps, np.eye(5))]
    return np.array(columns).T


for tolerance in (1e-8, 1e-9, 1e-10):
    run = solve_ivp(lambda t, y: system.derivative(t, np.append(y, 0.0))[:-1], (0.0, 20.0), np.zeros(5), method="Radau",
                    rtol=tolerance, atol=tolerance * np.array([1e-3, 1e-3, 1e-2, 1e-2, 1e-2]), jac=jacobian)
    print(tolerance, run.t.size, ", ".join(f"{value:.12e}" for value in run.y[:, -1]), flush=True)

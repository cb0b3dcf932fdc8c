#!/usr/bin/env python3
"""The run of Figure 4 by heyoka and SciPy beside this project's own benchmark, on one machine.

Needs `pip install heyoka numpy scipy`, and cargo. Every program integrates the same five equations from rest to
t = 24461860 steps of 2 pi / (10000 omega) = 604.999982934; the error is the largest difference of a component of
the end state from the value on which independent integrators agree. Compiling (heyoka's just-in-time compiler, ours) is not timed.
"""

import subprocess
import time
from pathlib import Path
from statistics import median

import heyoka
import numpy
import scipy
from scipy.integrate import solve_ivp

OMEGA_N = (4.04845139686289, 21.3562434253049)
ETA_1 = (0.417268652823084, -0.235757431026728)
ETA_2 = (0.275163559332428, 0.300562648266401)
THETA = (2.66720397414344e-4, 1.01697006538490e-3)
C_1, C_2 = 1.3450051225722, -19.378543266711
ALPHA, BETA, C, KAPPA = 1e-4, 1e-2, 1e-6, 1e-6
OMEGA = sum(OMEGA_N)
END = 24_461_860 * 2 * numpy.pi / (10_000 * OMEGA)
REFERENCE = numpy.array([1.2365676944e-2, 2.2433281133e-2, 8.7696801325e-2, 5.8895944582e-1, 27.811225437])


def rates(q, p, v, sine):
    """The right-hand side, for numbers and for heyoka's expressions alike."""
    s, w = q[0] + q[1], p[0] + p[1]
    accelerations = [
        (ALPHA * C_1 * w - C_2 * s * s - THETA[k] * v + OMEGA**2 * BETA * ETA_1[k] * sine) / ETA_2[k]
        - OMEGA_N[k] ** 2 * (q[k] + ALPHA * p[k])
        for k in (0, 1)
    ]
    return [p[0], p[1], *accelerations, (THETA[0] * p[0] + THETA[1] * p[1] - KAPPA * v) / C]


def error(state):
    return float(numpy.abs(numpy.asarray(state) - REFERENCE).max())


def measure(name, repetitions, run):
    """Prints minimum and median time of `run` in milliseconds, and the error of the state it returns."""
    times = []
    for _ in range(repetitions):
        start = time.perf_counter()
        state = run()
        times.append(1e3 * (time.perf_counter() - start))
    print(f"{name:<42} {min(times):>10.3f} {median(times):>10.3f}   {error(state):.1e}", flush=True)


def heyoka_run(tolerance):
    q1, q2, p1, p2, v = heyoka.make_vars("q1", "q2", "p1", "p2", "v")
    right = rates((q1, q2), (p1, p2), v, heyoka.sin(OMEGA * heyoka.time))
    system = list(zip((q1, q2, p1, p2, v), right))
    integrator = heyoka.taylor_adaptive(system, [0.0] * 5, tol=tolerance)

    def run():
        integrator.time = 0.0
        integrator.state[:] = 0.0
        integrator.propagate_until(END)
        return integrator.state.copy()

    return run


def scipy_run(tolerance):
    def right(t, y):
        return rates(y[:2], y[2:4], y[4], numpy.sin(OMEGA * t))

    return lambda: solve_ivp(
        right, (0.0, END), numpy.zeros(5), method="DOP853", rtol=tolerance, atol=tolerance, t_eval=(END,)
    ).y[:, -1]


def main():
    cpu = next(line for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name"))
    print(cpu.split(":")[1].strip())
    print(f"heyoka {heyoka.__version__}, SciPy {scipy.__version__}, NumPy {numpy.__version__}\n")
    # Ours before and after the others, because the clock of a machine is not constant.
    ours = ["cargo", "bench", "--quiet", "--bench", "integrators", "--", "--table"]
    here = Path(__file__).resolve().parent.parent
    subprocess.run(ours, cwd=here, check=True)
    for tolerance in (1e-10, 1e-12):
        measure(f"heyoka, tolerance {tolerance:g}", 201, heyoka_run(tolerance))
    measure("SciPy DOP853, tolerance 1e-9", 3, scipy_run(1e-9))
    subprocess.run(ours, cwd=here, check=True)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Reference values for tests/slow/figures, by a computation that shares nothing with the program.

From the paper's ten numbers it builds the N-mode system itself (equilibrium of the magnets, roots of the
transcendental equation, modal integrals by quadrature), integrates it from rest with SciPy's DOP853 and reads
off what the figures show. Everything is dimensionless but the voltage, which is in volts.

    python3 tests/reference/figures.py             everything (about ten minutes)
    python3 tests/reference/figures.py fig3 fig9   some

needs NumPy and SciPy. Each value is printed from runs at two relative tolerances; the digits they share are
those to compare with. Made with Python 3.11.7, NumPy 2.4.6, SciPy 1.17.1.
"""

import sys
from math import atan, cos, cosh, floor, ceil, hypot, pi, sin, sinh, sqrt

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq, minimize_scalar, root

C0, D, H, ETA, C, KAPPA, THETA = 0.5084, 0.15, 0.004167, 0.02, 1e-6, 1e-6, 2e-4


def magnet_force(gap):
    return C0 * (gap**-2 + (gap + 2 * H) ** -2 - 2 * (gap + H) ** -2)


SAG = brentq(lambda a: magnet_force(D + a) - 3 * a, 0, D, xtol=1e-17, rtol=1e-15)
GAP = D + SAG


def taylor(j):
    powers = GAP ** (-2 - j) + (GAP + 2 * H) ** (-2 - j) - 2 * (GAP + H) ** (-2 - j)
    return C0 * (j + 1) * (-1) ** (j + 1) * powers


C1, C2 = taylor(1), taylor(2)


class Mode:
    def __init__(self, n):
        def characteristic(x):
            return (x**3 * (1 / cosh(x) + cos(x))
                    - (C1 - ETA * x**4) * (cos(x) * sinh(x) - sin(x) * cosh(x)) / cosh(x))

        # One root between each two of the clamped-pinned beam, tan x = tanh x.
        pinned = [1e-3] + [brentq(lambda x: sin(x) - cos(x) * sinh(x) / cosh(x), (k + 0.2) * pi, (k + 0.3) * pi)
                           for k in range(1, n + 1)]
        x = brentq(characteristic, pinned[n - 1], pinned[n], xtol=1e-15, rtol=1e-15)
        self.omega = x * x
        denominator = 2 * (cos(x) * sinh(x) - sin(x) * cosh(x))
        a, b = (sin(x) + sinh(x)) / denominator, (cos(x) + cosh(x)) / denominator
        shape = lambda y: a * (np.cos(x * y) - np.cosh(x * y)) + b * (np.sinh(x * y) - np.sin(x * y))
        nodes, weights = np.polynomial.legendre.leggauss(60)
        values = shape(0.5 * (nodes + 1))
        self.eta1 = ETA + 0.5 * weights @ values
        self.eta2 = ETA + 0.5 * weights @ values**2
        slope = x * (a * (-sin(x) - sinh(x)) + b * (cosh(x) - cos(x)))
        self.theta = THETA * slope


MODES = [Mode(n) for n in range(1, 5)]
OMEGA_1, OMEGA_2 = MODES[0].omega, MODES[1].omega


def rest_exact(s):
    """F(s0) - F(s0 + s) - c1 s without cancellation."""
    def r(x):
        return s * s * (3 * x + 2 * s) / (x**3 * (x + s) ** 2)
    return -C0 * (r(GAP) + r(GAP + 2 * H) - 2 * r(GAP + H))


def rest_quadratic(s):
    return C2 * s * s


class System:
    def __init__(self, alpha, beta, omega, modes=2, rest=rest_quadratic):
        self.alpha, self.beta, self.omega, self.n, self.rest = alpha, beta, omega, modes, rest
        self.modes = MODES[:modes]
        self.period = 2 * pi / omega

    def derivative(self, t, y):
        """Of (q, dq/dt, v, integral of v^2)."""
        n = self.n
        y = y.tolist()
        s, w, v = sum(y[:n]), sum(y[n:2 * n]), y[2 * n]
        common = self.alpha * C1 * w - self.rest(s)
        drive = self.omega**2 * self.beta * sin(self.omega * t)
        rates = y[n:2 * n]
        current = -KAPPA * v
        for k, m in enumerate(self.modes):
            q, p = y[k], y[n + k]
            rates.append((common - m.theta * v + drive * m.eta1) / m.eta2 - m.omega**2 * (q + self.alpha * p))
            current += m.theta * p
        rates.append(current / C)
        rates.append(v * v)
        return np.array(rates)

    def solver(self, end, tolerance, start=None):
        y = np.zeros(2 * self.n + 2)
        if start is not None:
            y[:-1] = start
        return DOP853(self.derivative, 0.0, y, end, rtol=tolerance, atol=1e-3 * tolerance)

    def tip(self, y):
        return y[:self.n].sum(axis=0)

    def voltage(self, y):
        return y[2 * self.n]

    def rate(self, y):
        theta = np.array([m.theta for m in self.modes])
        return (theta @ y[self.n:2 * self.n] - KAPPA * y[2 * self.n]) / C

    def first_order(self, t):
        """Eq. (59) and its rate, from Eq. (43)."""
        o = self.omega
        a = [o * o * self.beta * m.eta1 / (m.eta2 * (m.omega**2 - o * o)) for m in self.modes]
        size = o * sum(x * m.theta for x, m in zip(a, self.modes)) / sqrt(KAPPA**2 + (C * o) ** 2)
        phase = atan(KAPPA / (C * o))
        return size * np.sin(o * t + phase), size * o * np.cos(o * t + phase)

    def linear(self, t):
        """Voltage of the linear system with damping and circuit."""
        n, o = self.n, self.omega
        a = np.zeros((2 * n + 1, 2 * n + 1))
        for j in range(2 * n + 1):
            unit = np.zeros(2 * n + 2)
            unit[j] = 1
            linear = System(self.alpha, 0.0, o, n, lambda s: 0.0)
            a[:, j] = linear.derivative(0.0, unit)[:-1]
        b = np.zeros(2 * n + 1, dtype=complex)
        b[n:2 * n] = [o * o * self.beta * m.eta1 / m.eta2 for m in self.modes]
        v = np.linalg.solve(1j * o * np.eye(2 * n + 1) - a, b)[2 * n]
        return (v * np.exp(1j * o * t)).imag


class Window:
    """Mean square and extremes between two times."""

    def __init__(self, system, start, end):
        self.system, self.start, self.end = system, start, end
        self.square = [None, None]
        one = system
        self.readings = {
            "v_peak": lambda y: np.abs(one.voltage(y)), "dv_dt_peak": lambda y: np.abs(one.rate(y)),
            "tip_max": one.tip, "tip_min": lambda y: -one.tip(y),
        }
        self.candidates = {name: [] for name in self.readings}
        self.best = dict.fromkeys(self.readings, 0.0)

    def see(self, t0, t1, dense):
        for i, t in enumerate((self.start, self.end)):
            if t0 < t <= t1 or (t == 0 and t0 == 0):
                self.square[i] = dense(t)[-1]
        low, high = max(t0, self.start), min(t1, self.end)
        if not low < high:
            return
        times = np.linspace(low, high, 17)
        states = dense(times)
        for name, reading in self.readings.items():
            values = reading(states)
            best = int(values.argmax())
            # Between samples it may rise by a fraction of a per cent.
            found = self.candidates[name]
            self.best[name] = max(self.best[name], values[best])
            if values[best] > 0.99 * self.best[name]:
                found.append((values[best], times[max(best - 1, 0)], times[min(best + 1, 16)], dense))

    def results(self):
        yield "v_rms", sqrt((self.square[1] - self.square[0]) / (self.end - self.start))
        for name, found in self.candidates.items():
            reading, best = self.readings[name], self.best[name]
            for seen, low, high, dense in found:
                if seen > 0.99 * self.best[name]:
                    # From the start of the bracket: the method's tolerance is relative to its variable.
                    top = minimize_scalar(lambda t: -reading(dense(low + t)), bounds=(0.0, high - low),
                                          method="bounded", options={"xatol": 1e-9})
                    best = max(best, -top.fun)
            yield name, -best if name == "tip_min" else best


def run(system, end, tolerance, window=None, times=()):
    """States at the ascending `times` and the numbers of the window."""
    solver = system.solver(end, tolerance)
    times, states = list(times), []
    window = window and Window(system, *window)
    while solver.status == "running":
        solver.step()
        wanted = len(states) < len(times) and times[len(states)] <= solver.t
        if not wanted and (window is None or solver.t < window.start):
            continue
        dense = solver.dense_output()
        while len(states) < len(times) and times[len(states)] <= solver.t:
            states.append(dense(times[len(states)]))
        if window:
            window.see(solver.t_old, solver.t, dense)
    assert solver.status == "finished", solver.status
    return np.array(states).T, dict(window.results()) if window else {}


def last_tenth(system, end):
    """The window of the program's summary: whole pairs of periods that cover the last tenth, up to the last
    whole period."""
    pairs = min(ceil(0.05 * end / system.period), floor(0.5 * end / system.period))
    last = floor(end / system.period)
    return (last - 2 * pairs) * system.period, last * system.period


def report(name, compute, tolerances=(1e-11, 1e-12)):
    results = [compute(tolerance) for tolerance in tolerances]
    for key in results[-1]:
        values = [result[key] for result in results]
        apart = abs(values[0] - values[1]) / max(abs(values[1]), 1e-300)
        print(f"{name:18} {key:14} {values[1]: .13e}   tolerances differ by {apart:.0e}", flush=True)


def period_one(alpha, beta, omega, end):
    def compute(tolerance):
        system = System(alpha, beta, omega)
        t = np.linspace(end - system.period, end, 500)
        last = floor(end / system.period + 1e-9)
        strobe = np.arange(last - 50, last) * system.period
        times = np.concatenate([strobe, t])
        order = np.argsort(times, kind="stable")
        states, numbers = run(system, end, tolerance, last_tenth(system, end), times[order])
        states = states[:, np.argsort(order)]
        strobe, states = states[:, :50], states[:, 50:]
        v, rate = system.voltage(states), system.rate(states)
        v59, rate59 = system.first_order(t)
        peak = np.abs(v).max()
        numbers["spread"] = np.ptp(system.voltage(strobe)) / peak
        numbers["from_dots"] = np.hypot(v - v59, (rate - rate59) / omega).max() / peak
        numbers["from_linear"] = np.abs(v - system.linear(t)).max() / peak
        return numbers
    return compute


def torus(end, count):
    """Extent of the Poincare map over the last `count` points."""
    def compute(tolerance):
        system = System(1e-4, 1e-2, OMEGA_1 + OMEGA_2)
        last = floor(end / system.period + 1e-9)
        times = np.arange(last - count, last) * system.period
        states, numbers = run(system, end, tolerance, last_tenth(system, end), times)
        for name, values in (("strobe_v", system.voltage(states)), ("strobe_rate", system.rate(states))):
            numbers |= {f"{name}_low": values.min(), f"{name}_high": values.max(),
                        f"{name}_rms": sqrt((values**2).mean())}
        return numbers
    return compute


def figure_9(tolerance):
    """The orbit of two periods, by shooting from a run's state."""
    system = System(1e-4, 1e-2, 2 * OMEGA_1)

    def twice(state):
        solver = system.solver(2 * system.period, tolerance, state)
        while solver.status == "running":
            solver.step()
        return solver.y[:-1]

    start = 400 * system.period
    states, _ = run(system, start, 1e-9, times=[start])
    scale = np.array([1e-2, 1e-2, 0.1, 0.1, 10])
    found = root(lambda x: (twice(x * scale) - x * scale) / scale, states[:-1, 0] / scale, tol=1e-13, method="hybr")
    state = found.x * scale
    solver = system.solver(2 * system.period, tolerance, state)
    window, points = Window(system, 0.0, 2 * system.period), {}
    window.square[0] = 0.0
    while solver.status == "running":
        solver.step()
        dense = solver.dense_output()
        if solver.t_old < system.period <= solver.t:
            points = {"odd_" + name: value for name, value in zip(NAMES, dense(system.period))}
        window.see(solver.t_old, solver.t, dense)
    even = {"even_" + name: value for name, value in zip(NAMES, state)}
    return dict(window.results()) | even | points | {"residual": abs((twice(state) - state) / scale).max()}


NAMES = ["q1", "q2", "p1", "p2", "v"]


def figure_12(tolerance):
    """When the tip passes one and ten beam lengths."""
    system = System(1e-4, 1e-2, 2 * OMEGA_2)
    solver, found = system.solver(2.0, tolerance), {}
    while len(found) < 2:
        solver.step()
        dense = solver.dense_output()
        for level in (1, 10):
            if abs(system.tip(solver.y)) >= level and level not in found:
                passage = lambda t: abs(system.tip(dense(t))) - level
                found[level] = brentq(passage, solver.t_old, solver.t, xtol=1e-15)
    return {f"passes_{level}": time for level, time in found.items()}


def last_tenth_of(alpha, beta, omega, modes, rest):
    def compute(tolerance):
        system = System(alpha, beta, omega, modes, rest)
        return run(system, 600.0, tolerance, last_tenth(system, 600.0))[1]
    return compute


SUM, DIFFERENCE = OMEGA_1 + OMEGA_2, OMEGA_2 - OMEGA_1
QUESTIONS = {
    "fig3": period_one(1e-3, 1e-3, 25.0, 602.0),
    "fig5": period_one(1e-3, 1e-3, DIFFERENCE, 603.0),
    "fig6": period_one(1e-4, 1e-2, DIFFERENCE, 603.0),
    "fig8": period_one(1e-3, 1e-3, 8.0, 604.0),
    "fig11": period_one(1e-3, 1e-3, 43.0, 601.0),
    "fig9": figure_9,
    "fig12": figure_12,
    "fig4": torus(605.0, 1000),
}
for label, numbers in (("fig3", (1e-3, 1e-3, 25.0)), ("fig4", (1e-4, 1e-2, SUM)),
                       ("fig9", (1e-4, 1e-2, 2 * OMEGA_1)), ("fig12", (1e-4, 1e-2, 2 * OMEGA_2))):
    for law, modes, rest in (("quadratic", 2, rest_quadratic), ("exact", 2, rest_exact), ("exact", 4, rest_exact)):
        if (label, law) != ("fig12", "quadratic"):
            QUESTIONS[f"{label} {law} {modes}"] = last_tenth_of(*numbers, modes, rest)
QUESTIONS["fig4 late"] = torus(4000.0, 1000)

if __name__ == "__main__":
    wanted = sys.argv[1:]
    print(f"gap {GAP:.15f} c1 {C1:.13f} c2 {C2:.12f} omega {OMEGA_1:.14f} {OMEGA_2:.13f}")
    for name, compute in QUESTIONS.items():
        if not wanted or name.split()[0] in wanted:
            report(name, compute)

#!/usr/bin/env python3
"""Mean power of Erturk & Inman's unimorph (J. Vib. Acoust. 130, 041002, 2008) by their closed form.

Textbook cantilever modes, Kelvin-Voigt damping with zeta_1 = 1 %, five modes; nothing of the solver is used.
"""
import math

E_I, MASS, LENGTH, CAPACITANCE, COUPLING = 0.0978471553, 0.013405, 0.1, 79.65e-9, 7.386125654e-5
WAVES = [1.8751040687, 4.6940911329, 7.8547574382, 10.9955407349, 14.1371683910]


def modes():
    for wave in WAVES:
        sigma = (math.sinh(wave) - math.sin(wave)) / (math.cosh(wave) + math.cos(wave))
        slope = math.sinh(wave) + math.sin(wave) - sigma * (math.cosh(wave) - math.cos(wave))
        omega = wave**2 * math.sqrt(E_I / (MASS * LENGTH**3))
        yield omega, COUPLING * slope * wave / LENGTH / math.sqrt(MASS), 2 * sigma / wave * math.sqrt(MASS)


def power_per_g2(frequency, load):
    first, omega = next(modes())[0], 2 * math.pi * frequency
    source = back = 0
    for own, coupling, participation in modes():
        zeta = 0.01 * own / first
        denominator = own**2 - omega**2 + 2j * zeta * own * omega
        source += 1j * omega * coupling * participation * 9.80665 / denominator
        back += 1j * omega * coupling**2 / denominator
    voltage = source / (1 / load + 1j * omega * CAPACITANCE + back)
    return abs(voltage) ** 2 / (2 * load)


for frequency, load in [(47.8, 17.38e3), (48.8, 91.2e3)]:
    print(f"{frequency} Hz, {load} ohm: {1e3 * power_per_g2(frequency, load):.7g} mW/g^2")

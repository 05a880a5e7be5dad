"""The fluid: density, bulk modulus, enthalpy and stored energy follow from one another."""

from __future__ import annotations

from collections.abc import Callable

import casadi
import numpy as np
import pytest
from casadi import SX
from hypothesis import given
from hypothesis import strategies as st

from arthur_acausal.components.hydraulic import Fluid

FLUIDS = {
    "liquid": Fluid(),
    "constant density": Fluid(constant_density=True),
    "air": Fluid(air=True, air_fraction=0.02),
    "cavitation": Fluid(cavitation=True, p_vapour=2e3),
    "other reference": Fluid(p_ref=101325.0, beta=1.2e9),
}
PRESSURES = st.floats(2e4, 4e7)


def value_and_slope(law: Callable[[SX], SX], p: float) -> tuple[float, float]:
    """Evaluate a law of pressure and its derivative."""
    x = SX.sym("p")
    y = SX(law(x))
    found = casadi.Function("law", [x], [y, casadi.jacobian(y, x)])(p)
    return float(found[0]), float(found[1])


@pytest.mark.parametrize("name", [n for n in FLUIDS if n != "constant density"])
@given(p=PRESSURES)
def test_enthalpy_is_the_integral_of_volume(name: str, p: float) -> None:
    fluid = FLUIDS[name]
    _, slope = value_and_slope(fluid.enthalpy, p)
    density, _ = value_and_slope(fluid.density, p)
    assert slope == pytest.approx(1 / density, rel=1e-12)


@pytest.mark.parametrize("name", [n for n in FLUIDS if n != "constant density"])
@given(p=PRESSURES)
def test_bulk_modulus_is_that_of_the_density(name: str, p: float) -> None:
    fluid = FLUIDS[name]
    density, slope = value_and_slope(fluid.density, p)
    modulus, _ = value_and_slope(fluid.bulk_modulus, p)
    assert modulus == pytest.approx(density / slope, rel=1e-9)


@pytest.mark.parametrize("name", [n for n in FLUIDS if n != "constant density"])
@given(p=PRESSURES)
def test_stored_energy_balances_flow_and_walls(name: str, p: float) -> None:
    """d(V u) = rho h dq - p dV for a fixed mass means u + p = rho h; at constant volume du/dp = h d(rho)/dp."""
    fluid = FLUIDS[name]
    u, du = value_and_slope(fluid.energy_density, p)
    h, _ = value_and_slope(fluid.enthalpy, p)
    density, d_density = value_and_slope(fluid.density, p)
    assert u + p == pytest.approx(density * h, rel=1e-9, abs=1e-3)
    assert du == pytest.approx(h * d_density, rel=1e-6, abs=1e-9)


def test_compressed_oil_at_207_bar() -> None:
    """q p is 0.7 % off at 207 bar: h rho_0/p = (1 - exp(-x))/x with x = p/beta."""
    p, fluid = 207e5, FLUIDS["liquid"]
    x = p / 1.4e9
    assert float(fluid.enthalpy(SX(p))) * 850 / p == pytest.approx((1 - np.exp(-x)) / x, rel=1e-12)
    assert 1 - float(fluid.enthalpy(SX(p))) * 850 / p == pytest.approx(0.0074, abs=1e-4)


def test_air_softens_the_fluid_at_low_pressure() -> None:
    """2 % of air at 1 atm: isentropic air alone has n p; the mixture's modulus is near n p/alpha."""
    fluid = FLUIDS["air"]
    low, high = (float(fluid.bulk_modulus(SX(p))) for p in (101325.0, 3e7))
    assert low == pytest.approx(1 / (0.98 / 1.4e9 + 0.02 / (1.4 * 101325.0)), rel=1e-3)
    assert high > 0.98 * 1.4e9


def test_cavities_keep_the_pressure_up() -> None:
    """Half of the volume is void at about half of beta_cavity below the vapour pressure."""
    fluid = FLUIDS["cavitation"]
    assert float(fluid.relative_volume(SX(2e3 - 1e5))) == pytest.approx(2.0, rel=1e-3)
    assert float(fluid.relative_volume(SX(1e6))) == pytest.approx(np.exp(-1e6 / 1.4e9), rel=1e-5)


def test_a_constant_density_stores_half_p_squared_over_beta() -> None:
    fluid = FLUIDS["constant density"]
    assert float(fluid.energy_density(SX(1e7))) == pytest.approx(1e14 / 2.8e9, rel=1e-12)
    assert float(fluid.throttling_loss(SX(1e-4), SX(2e7), SX(5e6))) == pytest.approx(1500.0, rel=1e-12)

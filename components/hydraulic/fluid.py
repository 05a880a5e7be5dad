"""The hydraulic fluid: what compresses, and what energy it carries."""

from __future__ import annotations

from casadi import SX, asinh, exp, expm1, sqrt

from arthur_acausal import Real, Record, parameter


class Fluid(Record):
    """A barotropic liquid: its density depends on pressure only.

    By default rho(p) = rho exp((p - p_ref)/beta), that is, the bulk modulus ``beta`` [Pa] is constant
    (Merritt 1967, ch. 2). Pressures are absolute. The options change the volume v(p) of a unit of mass,
    from which the bulk modulus -v/(dv/dp), enthalpy and stored energy all follow, so that mass and energy
    stay conserved:

    - ``constant_density``: v does not change. A volume then has p' = beta (q - V')/V as in the ARTHuR
      report, eq. 5.39, and mass is conserved to first order in p/beta only.
    - ``air``: the volume fraction ``air_fraction`` of undissolved air at ``p_air`` follows a polytrope
      ``n_air`` (Merritt 1967, ch. 2; Gholizadeh, Burton and Schoenau, Int. J. Fluid Power 12, 2011).
      Pressures stay positive.
    - ``cavitation``: below ``p_vapour`` cavities open with the low modulus ``beta_cavity``, which keeps the
      pressure from falling much further, whatever volume is drawn (column separation as in Wylie and
      Streeter 1993, ch. 8, with a compliance in place of an event). ``dp_cavity`` rounds the transition.
      Use it without ``air``, which has a floor of its own.

    rho, beta and nu are assumed values: a mineral oil of class ISO VG 32 at 40 degC. Valid where
    temperature is constant and p is far below beta.
    """

    constant_density: bool = False
    air: bool = False
    cavitation: bool = False
    rho: Real = parameter("kg/m^3", default=850.0, min=0.0, description="density at p_ref; assumed")
    beta: Real = parameter("Pa", default=1.4e9, min=0.0, description="bulk modulus of the liquid; assumed")
    nu: Real = parameter("m^2/s", default=32e-6, min=0.0, description="kinematic viscosity; assumed")
    p_ref: Real = parameter("Pa", default=0.0, description="pressure of the reference density")
    air_fraction: Real = parameter(
        "1", default=5e-3, min=0.0, max=0.5, description="volume fraction at p_air"
    )
    p_air: Real = parameter("Pa", default=101325.0, min=0.0)
    n_air: Real = parameter("1", default=1.4, min=1.01, description="polytropic exponent of the air")
    p_vapour: Real = parameter("Pa", default=0.0)
    beta_cavity: Real = parameter("Pa", default=1e5, min=1.0, description="modulus of the cavities")
    dp_cavity: Real = parameter("Pa", default=1e3, min=1e-3, description="width of the transition")

    @property
    def mu(self) -> SX:
        """Dynamic viscosity [Pa s] at the reference density."""
        return self.nu * self.rho

    @property
    def has_constant_modulus(self) -> bool:
        """Whether neither air nor cavities change the bulk modulus."""
        return self.constant_density or not (self.air or self.cavitation)

    def relative_volume(self, p: SX) -> SX:
        """Return rho(p_ref)/rho(p) [1]: the volume of a mass, over its volume at reference density."""
        if self.constant_density:
            return SX(1.0)
        v = exp(-(p - self.p_ref) / self.beta)
        if self.air:
            v = (1 - self.air_fraction) * v + self.air_fraction * (self.p_air / p) ** (1 / self.n_air)
        if self.cavitation:
            x = self.p_vapour - p
            v = v + (x + sqrt(x**2 + self.dp_cavity**2)) / (2 * self.beta_cavity)
        return v

    def density(self, p: SX) -> SX:
        """Return the density [kg/m^3] at the pressure ``p`` [Pa]."""
        return self.rho / self.relative_volume(p)

    def bulk_modulus(self, p: SX) -> SX:
        """Return the effective (tangent) bulk modulus [Pa] at ``p``: -v/(dv/dp)."""
        if self.has_constant_modulus:
            return self.beta
        compliance = exp(-(p - self.p_ref) / self.beta) / self.beta
        if self.air:
            share = self.air_fraction * (self.p_air / p) ** (1 / self.n_air)
            compliance = (1 - self.air_fraction) * compliance + share / (self.n_air * p)
        if self.cavitation:
            x = self.p_vapour - p
            compliance = compliance + (1 + x / sqrt(x**2 + self.dp_cavity**2)) / (2 * self.beta_cavity)
        return self.relative_volume(p) / compliance

    def pressure_rate(self, p: SX, q: SX, V: SX, V_rate: SX | float = 0.0) -> SX:
        """Return dp/dt [Pa/s] in a volume ``V`` [m^3] that grows by ``V_rate`` and takes ``q`` [m^3/s] in.

        From the conservation of its mass rho(p) V, with q the mass flow over the reference density; for
        constant density this is eq. 5.39 of the ARTHuR report.
        """
        return self.bulk_modulus(p) * (q * self.relative_volume(p) - V_rate) / V

    def enthalpy(self, p: SX) -> SX:
        """Return h(p) [J/kg], the integral of dp/rho: a flow q carries the power rho q h(p)."""
        x = p - self.p_ref
        if self.constant_density:
            return x / self.rho
        h = -self.beta * expm1(-x / self.beta)
        if self.air:
            n = self.n_air
            of_air = self.p_air * (p / self.p_air) ** ((n - 1) / n) * n / (n - 1)
            h = (1 - self.air_fraction) * h + self.air_fraction * of_air
        if self.cavitation:
            below, w = self.p_vapour - p, self.dp_cavity
            root = sqrt(below**2 + w**2)
            h = h - (below**2 + below * root + w**2 * asinh(below / w)) / (4 * self.beta_cavity)
        return h / self.rho

    def energy_density(self, p: SX) -> SX:
        """Return the energy stored in a unit of volume [J/m^3]: rho h - p, as m (h - p/rho) = V (rho h - p).

        For a fixed mass its change is -p dV; with the flow's rho q h and the walls' p dV it balances
        exactly. For constant density it is the usual p^2/(2 beta), which balances for rigid volumes only.
        """
        x = (p - self.p_ref) / self.beta
        if self.constant_density:
            return self.beta * x**2 / 2 - self.p_ref
        if self.has_constant_modulus:
            return self.beta * (expm1(x) - x) - self.p_ref
        return self.rho * self.enthalpy(p) / self.relative_volume(p) - p

    def throttling_loss(self, q: SX, p_a: SX, p_b: SX) -> SX:
        """Return the power [W] that a flow ``q`` loses from ``p_a`` to ``p_b`` [Pa]: rho q (h_a - h_b)."""
        if self.constant_density:
            return q * (p_a - p_b)
        return self.rho * q * (self.enthalpy(p_a) - self.enthalpy(p_b))

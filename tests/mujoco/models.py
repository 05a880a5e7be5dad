"""MJCF models for the tests."""

from __future__ import annotations

LEG = """
<body name="{n}_hip" pos="{x} {y} 0">
  <joint name="{n}_abd" axis="1 0 0" damping="0.1"/>
  <geom type="capsule" size=".02" fromto="0 0 0 0 {d} 0" mass="0.3"/>
  <body name="{n}_thigh" pos="0 {d} 0">
    <joint name="{n}_hip" axis="0 1 0" damping="0.1"/>
    <geom type="capsule" size=".02" fromto="0 0 0 0 0 -.2" mass="0.4"/>
    <body name="{n}_shank" pos="0 0 -.2">
      <joint name="{n}_knee" axis="0 1 0" damping="0.1"/>
      <geom type="capsule" size=".015" fromto="0 0 0 0 0 -.2" mass="0.15" contype="0" conaffinity="0"/>
      <geom name="{n}_foot" type="sphere" size=".02" pos="0 0 -.2" mass=".05" friction="0.8"/>
    </body>
  </body>
</body>"""

FEET = (("fl", 0.2, 0.1, 0.05), ("fr", 0.2, -0.1, -0.05), ("rl", -0.2, 0.1, 0.05), ("rr", -0.2, -0.1, -0.05))

QUADRUPED = f"""
<mujoco model="quadruped">
  <default><geom contype="1" conaffinity="0" solref="0.01 1" solimp="0 0.95 0.005"/></default>
  <worldbody>
    <geom name="floor" type="plane" size="5 5 .1" conaffinity="1" contype="0"/>
    <body name="trunk" pos="0 0 .4">
      <freejoint name="trunk"/>
      <geom name="trunk" type="box" size=".2 .1 .05" mass="6"/>
      <site name="back" pos="0 0 .05"/>
      {"".join(LEG.format(n=n, x=x, y=y, d=d) for n, x, y, d in FEET)}
    </body>
  </worldbody>
</mujoco>"""
"""A free trunk on four legs of three hinges, 18 degrees of freedom, on a floor."""

PENDULUM = """
<mujoco>
  <option gravity="0 0 -9.81"/>
  <worldbody>
    <body>
      <joint name="hinge" axis="0 -1 0"/>
      <geom type="sphere" size=".05" pos="0 0 -.5" mass="2"/>
    </body>
  </worldbody>
</mujoco>"""

SPHERE = """
<mujoco>
  <option gravity="0 0 -9.81"/>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 .1" solref="0.02 1" solimp="0 0.9 0.01"/>
    <body name="ball" pos="0 0 .15">
      <freejoint/>
      <geom name="ball" type="sphere" size=".1" mass="1" solref="0.02 1" solimp="0 0.9 0.01"/>
    </body>
  </worldbody>
</mujoco>"""
"""A sphere 5 cm above a floor; the contact's impedance begins at zero, so that its onset is smooth."""


FREE_BODY = """
<mujoco>
  <option gravity="0 0 0"/>
  <worldbody>
    <body name="body"><freejoint/><inertial mass="1" pos="0 0 0" diaginertia="1 2 3"/></body>
  </worldbody>
</mujoco>"""

LINK = """<body pos="0 0 {z}"><joint name="j{k}" axis="{axis}"/>
<geom type="capsule" size="0.04" fromto="0 0 0 0.05 0 .3" mass="{mass}"/>"""
AXES = ("0 0 1", "0 1 0", "0 1 0", "1 0 0", "0 1 0", "1 0 0")
ARM = f"""
<mujoco>
  <option gravity="0 0 -9.81"/>
  <default><geom contype="0" conaffinity="0"/></default>
  <worldbody>
    {"".join(LINK.format(z=0.3 * (k > 0), k=k, axis=a, mass=3 - 0.4 * k) for k, a in enumerate(AXES))}
    {"</body>" * len(AXES)}
  </worldbody>
</mujoco>"""
"""Six hinges in a row, without damping, joint limits or contacts."""


def joints(extra: str = "", option: str = "", actuator: str = "", attributes: str = "") -> str:
    """One hinge with what is given beside it."""
    return (
        f"<mujoco>{option}<worldbody><body><joint name='j' {attributes}/><geom size='1'/></body></worldbody>"
        f"<actuator>{actuator}</actuator>{extra}</mujoco>"
    )

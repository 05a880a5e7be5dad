"""Whole systems composed from the component library.

``REGISTRY`` gives the models that have a short name: name -> "package.module:Class".
"""

REGISTRY: dict[str, str] = {
    "arthur.powertrain": "arthur_acausal.models.arthur.powertrain:Powertrain",
    "arthur.demo": "arthur_acausal.models.arthur.demo:Demo",
    "arthur.quadruped": "arthur_acausal.models.arthur.quadruped:Quadruped",
    "examples.bouncing_ball": "arthur_acausal.models.examples.bouncing_ball:BouncingBall",
    "examples.rc_ladder": "arthur_acausal.models.examples.rc_ladder:RCLadder",
    "examples.jack": "arthur_acausal.models.examples.jack:Jack",
    "examples.accumulator_charge": "arthur_acausal.models.examples.accumulator_charge:AccumulatorCharge",
    "examples.power_supply": "arthur_acausal.models.examples.power_supply:PowerSupply",
    "examples.room_heating": "arthur_acausal.models.examples.room_heating:RoomHeating",
    "examples.motor_control": "arthur_acausal.models.examples.motor_control:MotorControl",
    "examples.clutch_engagement": "arthur_acausal.models.examples.clutch_engagement:ClutchEngagement",
    "examples.stick_slip": "arthur_acausal.models.examples.stick_slip:StickSlip",
    "examples.double_pendulum": "arthur_acausal.models.examples.double_pendulum:DoublePendulum",
    "examples.four_bar": "arthur_acausal.models.examples.four_bar:FourBar",
    "examples.slider_crank": "arthur_acausal.models.examples.slider_crank:SliderCrank",
}

DESCRIPTIONS: dict[str, str] = {
    "arthur.powertrain": "hydraulic powertrain of the ARTHuR quadruped, with external inputs",
    "arthur.demo": "the powertrain under twelve trot-like current profiles, from its cold start",
    "arthur.quadruped": "the whole robot: battery, hydraulics, MuJoCo's rigid bodies, locomotion controller",
    "examples.bouncing_ball": "state events and reinit",
    "examples.rc_ladder": "a chain of n resistors and capacitors",
    "examples.jack": "pressure source, orifice, ram and mass",
    "examples.accumulator_charge": "check valve, accumulator and relief valve",
    "examples.power_supply": "transformer, bridge of ideal diodes, capacitor and load",
    "examples.room_heating": "heat transfer under a thermostat",
    "examples.motor_control": "a direct-current motor under speed control",
    "examples.clutch_engagement": "dry friction that ends in sticking",
    "examples.stick_slip": "a block on a moving belt",
    "examples.double_pendulum": "planar bodies and joints, a chain",
    "examples.four_bar": "planar bodies and joints, a kinematic loop",
    "examples.slider_crank": "turning becomes sliding, a kinematic loop with flanges",
}

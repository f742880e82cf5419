"""Motors with their gears, found by name: `motor: unitree_5020`.

Each number has its source beside it. What two sources give very differently, or what was never
published or measured, is left out. All is at the joint, behind the gear, except for
`rotor_inertia`. Stall torques and no-load speeds are those of the voltage that is named. For the
modules with brushless motors (Unitree, CubeMars, RobStride, Damiao), the stall torque is the
greatest torque that their makers give, which they keep up to some speed: the line to the no-load
speed is on the safe side.

Sources, as looked up in November 2026:

- [EM] ROBOTIS e-manual, https://emanual.robotis.com/docs/en/dxl/, the page of each model. The stall
  torque is an instant maximum.
- [BAM] Rhoban/bam, bam/params/MOTOR/m1.json (commit 1b5a1ce): armatures identified on a pendulum.
- [WBT] HybridRobotics/whole_body_tracking, source/whole_body_tracking/whole_body_tracking/robots/
  g1.py (commit cd65172).
- [MJL] mjlab 1.6.0, mjlab/asset_zoo/robots/unitree_g1/g1_constants.py, unitree_go1/
  go1_constants.py, i2rt_yam/yam_constants.py.
- [URL] unitree_rl_lab, assets/robots/unitree_actuators.py, as in openreachtech/unitree_rl_lab
  (commit 5bba858): "no-load speed test", "peak torque test".
- [RS] RobStride/Product_Information (commit ba7236b), the user manuals of 2026-04-28, sections 1.2
  to 1.4; speeds within 10 %.
- [RSID] T-K-233/Robstride-SysID, README.md (commit a71252f): identified with the output unloaded.
- [CM] https://www.cubemars.com, the page of each product, as transcribed in nathmo/
  highTorqueDensityMotorReview, research/cubemars_rich.csv (commit 3151088); inertia of the rotor.
- [DM] Damiao's manuals: dmBots/DM-J4310-2EC (commit 1f80c57), V1.1.
- [SEED] https://wiki.seeedstudio.com/damiao_series.
- [FT] roboninecom/SO-ARM100-101-Parallel-Gripper#5, where Feetech answers; data sheets in
  TheRobotStudio/SO-ARM100#134, with speeds and torques measured.
"""

from __future__ import annotations

MOTORS: dict[str, dict[str, str]] = {
    # --- Dynamixel, at 12 V unless a comment says otherwise. No rotor inertia is published.
    "xm430_w350": {  # identified armatures are 0.045 and 0.0012 kg·m², which is too far apart
        "gear": "353.5",  # [EM]
        "stall_torque": "4.1 N*m",  # [EM], 2.3 A
        "no_load_speed": "46 rpm",  # [EM]
    },
    "xm430_w210": {
        "gear": "212.6",  # [EM]
        "stall_torque": "3.0 N*m",  # [EM], 2.3 A
        "no_load_speed": "77 rpm",  # [EM]
    },
    "xm540_w270": {
        "gear": "272.5",  # [EM]
        "stall_torque": "10.6 N*m",  # [EM], 4.4 A
        "no_load_speed": "30 rpm",  # [EM]
    },
    "xh540_w270": {
        "gear": "272.5",  # [EM]
        "stall_torque": "9.9 N*m",  # [EM], 4.9 A
        "no_load_speed": "39 rpm",  # [EM]
    },
    "xl430_w250": {  # at 11.1 V
        "gear": "258.5",  # [EM]
        "stall_torque": "1.4 N*m",  # [EM], 1.3 A
        "no_load_speed": "57 rpm",  # [EM]
    },
    "xl330_m288": {  # at 5 V
        "gear": "288.4",  # [EM]
        "armature": "0.0018141672784458866",  # [BAM], xl330
        "stall_torque": "0.52 N*m",  # [EM], 1.47 A
        "no_load_speed": "103 rpm",  # [EM]
    },
    "xl320": {  # at 7.4 V
        "gear": "238",  # [EM]
        "armature": "0.0011189506223419352",  # [BAM], xl320
        "stall_torque": "0.39 N*m",  # [EM], 1.1 A
        "no_load_speed": "114 rpm",  # [EM]
    },
    "mx_28": {
        "gear": "193",  # [EM]
        "stall_torque": "2.5 N*m",  # [EM], 1.4 A
        "no_load_speed": "55 rpm",  # [EM]
    },
    "mx_64": {
        "gear": "200",  # [EM]
        "armature": "0.011951238325312509",  # [BAM], mx64
        "stall_torque": "6.0 N*m",  # [EM], 4.1 A
        "no_load_speed": "63 rpm",  # [EM]
    },
    "mx_106": {
        "gear": "225",  # [EM]
        "armature": "0.026609234235148084",  # [BAM], mx106
        "stall_torque": "8.4 N*m",  # [EM], 5.2 A
        "no_load_speed": "45 rpm",  # [EM]
    },
    # --- Feetech.
    "sts3215_7v4": {  # STS3215-C001, at 7.4 V
        "gear": "345",  # [FT]
        "armature": "0.02840336348682085",  # [BAM], feetech_sts3215_7_4V
        "stall_torque": "19.5 kgf*cm",  # [FT]
        "no_load_speed": "52 rpm",  # 0.192 s for 60°, littlebirdelectronics.com.au, ST3215 19.5 kg
    },
    "sts3215_12v": {  # STS3215-C018 and C047, at 12 V; its fitted armature is a bound of the fit
        "gear": "345",  # [FT]
        "stall_torque": "30 kgf*cm",  # [FT]; about 35 were measured
        "no_load_speed": "45 rpm",  # [FT]; 46 were measured
    },
    # --- Unitree. The armature holds the stages of the gear as well, so that it is more than the
    # inertia of the rotor times the square of the gear.
    "unitree_5020": {  # G1: shoulder, elbow, wrist roll; two each at ankle and waist
        "gear": "16",  # [MJL], (46/18 + 1)·(56/16 + 1)
        "armature": "0.003609725",  # [WBT], [URL]; of [MJL]'s parts the same
        "stall_torque": "24.8 N*m",  # [URL]; [WBT] limits the effort to 25
        "no_load_speed": "40.13 rad/s",  # [URL]; [WBT] limits the speed to 37
    },
    "unitree_7520_14": {  # G1: hip pitch and yaw, waist yaw
        "gear": "14.318181818181817",  # [MJL], 4.5·(48/22 + 1)
        "armature": "0.010177520",  # [WBT], [URL]; of [MJL]'s parts 0.01017752004
        "stall_torque": "71 N*m",  # [URL]; [WBT] limits the effort to 88
        "no_load_speed": "35.52 rad/s",  # [URL]; [WBT] limits the speed to 32
    },
    "unitree_7520_22": {  # G1: hip roll, knee
        "gear": "22.5",  # [MJL], 4.5·5
        "armature": "0.025101925",  # [WBT], [URL]; of [MJL]'s parts the same
        "stall_torque": "111 N*m",  # [URL]; [WBT] limits the effort to 139
        "no_load_speed": "22.7 rad/s",  # [URL]; [WBT] limits the speed to 20
    },
    "unitree_4010": {  # G1: wrist pitch and yaw
        "gear": "25",  # [MJL], 5·5
        "armature": "0.00425",  # [WBT], [URL]; of [MJL]'s rotor the same
        "stall_torque": "4.8 N*m",  # [URL]; [WBT] limits the effort to 5
        "no_load_speed": "24.76 rad/s",  # [URL]; [WBT] limits the speed to 22
    },
    "unitree_go1": {  # Go1: hip and thigh
        "gear": "6",  # [MJL]
        "rotor_inertia": "1.11842e-4",  # [MJL], of Unitree's go1.urdf, hip_rotor
    },
    # --- CubeMars, at 48 V.
    "ak60_6_v3": {  # KV80
        "gear": "6",  # [CM]
        "rotor_inertia": "243.5 g*cm^2",  # [CM]
        "stall_torque": "9 N*m",  # [CM], peak, 11.2 A; rated 3
        "no_load_speed": "640 rpm",  # [CM]
    },
    "ak70_10": {  # KV100
        "gear": "10",  # [CM]
        "rotor_inertia": "753.479 g*cm^2",  # [CM]
        "stall_torque": "24.8 N*m",  # [CM], peak, 23.2 A; rated 8.3
        "no_load_speed": "480 rpm",  # [CM]
    },
    "ak80_6": {  # KV100
        "gear": "6",  # [CM]; the same in dfki-ric-underactuated-lab/torque_limited_simple_pendulum
        "rotor_inertia": "607.19 g*cm^2",  # the same, hardware/testbench_description.md; [CM] 607
        "stall_torque": "12 N*m",  # both, peak; rated 6
        "no_load_speed": "800 rpm",  # [CM]
    },
    "ak80_9_v3": {  # KV100; the older AK80-9, of 18 N·m, is another motor
        "gear": "9",  # [CM]
        "rotor_inertia": "1118.324 g*cm^2",  # [CM]
        "stall_torque": "22 N*m",  # [CM], peak, 28 A; rated 9
        "no_load_speed": "570 rpm",  # [CM]
    },
    "ak10_9_v3": {  # KV60
        "gear": "9",  # [CM]
        "rotor_inertia": "1002 g*cm^2",  # [CM]
        "stall_torque": "53 N*m",  # [CM], peak, 31.9 A; rated 18
        "no_load_speed": "320 rpm",  # [CM]
    },
    "ak80_64": {  # KV80
        "gear": "64",  # [CM]
        "rotor_inertia": "564.5 g*cm^2",  # [CM]
        "stall_torque": "120 N*m",  # [CM], peak, 19 A; rated 48
        "no_load_speed": "75 rpm",  # [CM]
    },
    # --- RobStride, at 48 V.
    "robstride_02": {
        "gear": "7.75",  # [RS]
        "armature": "0.01369",  # [RSID], within 1.7 %
        "stall_torque": "17 N*m",  # [RS], peak; rated 6
        "no_load_speed": "410 rpm",  # [RS]
    },
    "robstride_05": {
        "gear": "7.75",  # [RS]
        "armature": "0.00678",  # [RSID], within 6.5 %
        "stall_torque": "5.5 N*m",  # [RS], peak; rated 1.6
        "no_load_speed": "480 rpm",  # [RS]
    },
    "robstride_06": {
        "gear": "9",  # [RS]
        "armature": "0.01647",  # [RSID], within 5.9 %
        "stall_torque": "36 N*m",  # [RS], peak; rated 11
        "no_load_speed": "480 rpm",  # [RS]
    },
    # --- Damiao, at 24 V.
    "dm_j4310": {  # DM-J4310-2EC V1.1
        "gear": "10",  # [DM], [SEED]
        "rotor_inertia": "1.8e-5",  # [SEED], of the drive; [MJL] has the armature 0.0018
        "stall_torque": "7 N*m",  # [DM], peak; rated 3
        "no_load_speed": "200 rpm",  # [DM]
    },
    "dm_j4340": {  # DM-J4340-2EC and 4340P
        "gear": "40",  # [SEED]
        "rotor_inertia": "2.0e-5",  # [SEED]; [MJL] has the armature 0.032
        "stall_torque": "27 N*m",  # [SEED], peak; rated 9
        "no_load_speed": "52.5 rpm",  # [SEED]
    },
}  # fmt: skip
"""The motors by name, each with entries of an `actuator` as they are written in YAML."""


def spelled(name: str) -> str:
    """Return how the table spells a name: `XM430-W350` is `xm430_w350`."""
    return name.strip().lower().replace("-", "_").replace(" ", "_")

"""A retrieval made by hand: an arm like the PR2's takes a can out of a shelf and brings it home."""
import json
import math
import os

# name, child, offset, type, axis, limits, velocity (rad/s), shapes of the child (URDF)
BOX = '<collision><origin xyz="{}"/><geometry><box size="{}"/></geometry></collision>'
TUBE = ('<collision><origin xyz="{}" rpy="0 1.5707963 0"/><geometry><cylinder radius="{}" length="{}"/></geometry>'
        "</collision>")
BALL = '<collision><geometry><sphere radius="{}"/></geometry></collision>'
CHAIN = [
    ("shoulder_pan", "shoulder_pan_link", "0 -0.188 0", "revolute", "0 0 1", (-2.2854, 0.7146), 2.088,
     '<collision><origin xyz="0 0 -0.1"/><geometry><cylinder radius="0.12" length="0.3"/></geometry></collision>'),
    ("shoulder_lift", "shoulder_lift_link", "0.1 0 0", "revolute", "0 1 0", (-0.5236, 1.3963), 2.082, ""),
    ("upper_arm_roll", "upper_arm_link", "0 0 0", "revolute", "1 0 0", (-3.9, 0.8), 3.27, TUBE.format("0.2 0 0", 0.08, 0.4)),
    ("elbow_flex", "elbow_link", "0.4 0 0", "revolute", "0 1 0", (-2.3213, 0), 3.3, BALL.format(0.08)),
    ("forearm_roll", "forearm_link", "0 0 0", "continuous", "1 0 0", None, 3.6, TUBE.format("0.22 0 0", 0.06, 0.22)),
    ("wrist_flex", "wrist_link", "0.321 0 0", "revolute", "0 1 0", (-2.18, 0), 3.078, BALL.format(0.04)),
    ("wrist_roll", "palm", "0 0 0", "continuous", "1 0 0", None, 3.6,
     BOX.format("0.077 0 0", "0.096 0.101 0.049") + BOX.format("0.12 0.028 0", "0.104 0.04 0.04")
     + BOX.format("0.12 -0.028 0", "0.104 0.04 0.04")),
]
JOINTS = [row[0] for row in CHAIN]


def urdf():
    text = ['<robot name="pr2_like"><link name="base"/>',
            f'<link name="torso">{BOX.format("-0.1 0 -0.2", "0.3 0.4 0.6")}</link>',
            '<joint name="torso_fixed" type="fixed"><parent link="base"/><child link="torso"/>'
            '<origin xyz="-0.05 0 0.890675"/></joint>']
    parent = "torso"
    for name, child, offset, kind, axis, limits, velocity, shapes in CHAIN:
        low, high = limits or (0, 0)
        text.append(f'<link name="{child}">{shapes}</link><joint name="{name}" type="{kind}"><parent link="{parent}"/>'
                    f'<child link="{child}"/><origin xyz="{offset}"/><axis xyz="{axis}"/>'
                    f'<limit lower="{low}" upper="{high}" velocity="{velocity}" effort="10"/></joint>')
        parent = child
    text.append('<link name="tool"/><joint name="tool_fixed" type="fixed"><parent link="palm"/><child link="tool"/>'
                '<origin xyz="0.18 0 0"/></joint></robot>\n')
    return "".join(text)


def over_board(pan, lift=-0.3):
    return [pan, lift, -math.pi, -0.6, 0.0, 0.0, 0.0]


def body(name, shape, at, more):
    return f"  - {{id: {name}, shape: {shape}, pose: {{position: {at}, rpy: [0, 0, 0]}}, {more}}}\n"


def problem():
    def wall(name, size, at, touch="forbidden"):
        return body(name, f"{{box: {{size: {size}}}}}", at, f"fixture: true, touch: {touch}")

    def can(name, pan, movable, radius=0.035):
        x, y = -0.05 + 0.94 * math.cos(pan), -0.188 + 0.94 * math.sin(pan)
        return body(name, f"{{cylinder: {{radius: {radius}, length: 0.1}}}}", [round(x, 4), round(y, 4), 0.82],
                    f"mass: 0.2, friction: 0.25, movable: {str(movable).lower()}")

    start = "{" + ", ".join(f"{name}: {value}" for name, value in zip(JOINTS, over_board(-0.6, -0.45))) + "}"
    return ("format: mamo-problem/1\n"
            f"robot: {{urdf: shelf_arm.urdf, base: base, tip: tool, joints: [{', '.join(JOINTS)}], start: {start}, speed_scale: 0.1}}\n"
            "task: {kind: retrieve, object: soup, pregrasp: {position: [0.85, -0.3, 0.86], rpy: [0, 0, 0]}, home: start}\n"
            "objects:\n"
            + wall("board", [0.6, 1.4, 0.04], [0.85, -0.3, 0.75], "support") + wall("back", [0.03, 1.4, 0.6], [1.16, -0.3, 1.03])
            + wall("top", [0.6, 1.4, 0.03], [0.88, -0.3, 1.34]) + wall("left", [0.6, 0.03, 0.6], [0.86, 0.415, 1.03])
            + wall("right", [0.6, 0.03, 0.6], [0.86, -1.015, 1.03])
            + can("soup", 0.0, False) + can("mug", 0.13, True) + can("jar", 0.4, True, 0.05) + can("vase", -0.85, False, 0.03)
            + "constraints: {profile: full}\n")


def segment(kind, path):
    speed = [0.1 * row[6] for row in CHAIN]
    points, t = [{"t": 0.0, "q": path[0]}], 0.0
    for before, after in zip(path, path[1:]):
        t += 1.01 * max(abs(b - a) / v for a, b, v in zip(before, after, speed))
        points.append({"t": t, "q": after})
    return {"kind": kind, "object": "soup", "joint_names": JOINTS, "points": points, "objects_after": {}}


def plan(deep):
    home, beside, at = over_board(-0.6, -0.45), over_board(-0.13), over_board(0.0)
    lifted = over_board(0.0, -0.28) if deep else over_board(0.0, -0.45)
    # The fingers close on the can sideways, and with it in hand pass the mug on the way up.
    return {"segments": [segment("approach", [home, over_board(-0.13, -0.45), beside]), segment("grasp", [beside, at]),
                         segment("extract", [at, lifted, home])]}


def write(folder, deep=False):
    """Files of the problem and of a plan that holds; deep: of one that presses the can into the board."""
    names = ("shelf_arm.urdf", "retrieve.yaml", "deep.json" if deep else "retrieve.json")
    paths = [os.path.join(folder, name) for name in names]
    for path, text in zip(paths, (urdf(), problem(), json.dumps(plan(deep)))):
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    return paths[1], paths[2]

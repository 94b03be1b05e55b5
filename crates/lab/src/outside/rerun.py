"""Writes a moving mechanism as a Rerun recording with its blueprint: rerun.py FILM.json OUT.rrd

Needs rerun-sdk. The picture is seen from above. A plot has the values of the reference and of all engines; a plot below
has the errors of the engines.
"""

import json
import sys

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

TIME = "simulated_time"
ROOT = "mechanism"
ARROW = [230, 60, 60, 255]
COLOURS = [[86, 180, 233], [230, 120, 0], [0, 158, 115], [204, 121, 167]]
GREY = [154, 154, 154]


def column(times):
    """Times (s) as a timeline of durations."""
    return [rr.TimeColumn(TIME, duration=np.asarray(times, dtype=float))]


def draw(path, part):
    """The drawing of one link, in its frame."""
    lines = part["lines"]
    if lines:
        strips = rr.LineStrips3D(
            [line["points"] for line in lines],
            radii=[line["thickness"] / 2 for line in lines],
            colors=[line["rgba"] for line in lines],
        )
        rr.log(f"{path}/lines", strips, static=True)
    for number, area in enumerate(part["areas"]):
        points = area["points"]
        mesh = rr.Mesh3D(
            vertex_positions=points,
            triangle_indices=np.arange(len(points)).reshape(-1, 3),
            albedo_factor=area["rgba"],
        )
        rr.log(f"{path}/area_{number}", mesh, static=True)
    discs = part["discs"]
    if discs:
        points = rr.Points3D(
            [disc["at"] for disc in discs],
            radii=[disc["radius"] for disc in discs],
            colors=[disc["rgba"] for disc in discs],
        )
        rr.log(f"{path}/pins", points, static=True)
    texts = part["texts"]
    if texts:
        labels = rr.Points3D(
            [text["at"] for text in texts],
            labels=[text["text"] for text in texts],
            radii=0.0,
            colors=GREY,
            show_labels=True,
        )
        rr.log(f"{path}/names", labels, static=True)


def entity(*names):
    """Path of an entity; names may contain any characters."""
    return rr.new_entity_path(list(names)).lstrip("/")


def picture(film):
    """All links and their motion."""
    frames = {name: entity(ROOT, *name.split("/", 1)) for name in film["poses"]}
    for part in film["parts"]:
        draw(frames.get(part["frame"], entity(ROOT, "ground")), part)
    for name, path in frames.items():
        poses = np.asarray(film["poses"][name])
        half = poses[:, 2] / 2
        zero = np.zeros(len(half))
        turns = np.column_stack([zero, zero, np.sin(half), np.cos(half)])
        places = np.column_stack([poses[:, :2], zero])
        rr.send_columns(path, column(film["times"]), rr.Transform3D.columns(translation=places, quaternion=turns))
    for name, rows in film["arrows"].items():
        rows = np.asarray(rows)
        high = np.full(len(rows), film["height"] * 0.02)
        feet, tips = np.column_stack([rows[:, 1:3], high]), np.column_stack([rows[:, 3:5], 0 * high])
        path = entity("forces", *name.split("/", 1))
        rr.log(path, rr.Arrows3D.from_fields(colors=ARROW, radii=film["height"] * 0.004), static=True)
        rr.send_columns(path, column(rows[:, 0]), rr.Arrows3D.columns(vectors=tips, origins=feet))


def plots(film):
    """One view for each plot; the name of a line is its label."""
    views = []
    for number, plot in enumerate(film["plots"]):
        paths = []
        for order, line in enumerate(plot["lines"]):
            rows = np.asarray(line["values"])
            if not len(rows):
                continue
            # Later paths are drawn over earlier ones: the thin line of an engine over the broad one of the reference.
            path = entity("plots", str(number), f"{order} {line['label']}")
            side = line["side"]
            style = rr.SeriesLines(
                names=line["label"],
                colors=GREY if side is None else COLOURS[side % len(COLOURS)],
                widths=6.0 if side == 0 else 2.0,
            )
            rr.log(path, style, static=True)
            rr.send_columns(path, column(rows[:, 0]), rr.Scalars.columns(scalars=rows[:, 1]))
            paths.append(path)
        view = rrb.TimeSeriesView(name=plot["title"], origin="/", contents=[f"+ /{path}" for path in paths])
        views.append(view)
    return views


def main(source, target):
    """Reads the film and writes the recording."""
    with open(source, encoding="utf-8") as stream:
        film = json.load(stream)
    rr.init(f"linkproof {film['name']}", recording_id=film["name"])
    x, y = film["centre"]
    # The camera's field of view is 55 degrees: at this distance, the whole height is visible.
    eye = rrb.EyeControls3D(
        kind=rrb.Eye3DKind.Orbital,
        position=[x, y, film["height"]],
        look_target=[x, y, 0.0],
        eye_up=[0.0, 1.0, 0.0],
    )
    space = rrb.Spatial3DView(
        name=film["name"],
        origin="/",
        contents=[f"+ /{ROOT}/**", "+ /forces/**"],
        eye_controls=eye,
        line_grid=False,
    )
    views = plots(film)
    body = rrb.Horizontal(space, rrb.Vertical(*views), column_shares=[3, 2]) if views else space
    panel = rrb.TimePanel(
        state="collapsed", timeline=TIME, playback_speed=film["speed"], loop_mode="all", play_state="playing"
    )
    blueprint = rrb.Blueprint(
        body, panel, rrb.BlueprintPanel(state="collapsed"), rrb.SelectionPanel(state="collapsed"), auto_views=False
    )
    rr.save(target, default_blueprint=blueprint)
    picture(film)


main(*sys.argv[1:])

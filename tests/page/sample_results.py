"""A small results directory that has something for every view of the page, and two rendered scenes."""

import json
import os
import pathlib
import subprocess

# What a record says is text, whatever it looks like.
HOSTILE = '</script><b id="broken">bold</b>'


def check(kind, subject, verdict="pass", expected="pass", **more):
    record = {
        "format": "plumbline.check/1", "check": kind, "subject": subject, "verdict": verdict, "expected": expected,
        "estimate": 0.5002, "reference": 0.5, "tolerance": 0.005, "bound": 0.0008, "detectable": 0.0009,
        "p_value": 0.4, "interval_low": 0.4996, "interval_high": 0.5008, "samples": 25000, "seconds": 0.125,
        "leaned_on": "exact variance", "reason": "", "diagnosis": "", "seed": 7,
        "replay": "PLUMBLINE_SEED=7 ctest --preset release -R '^A\\.B$'", "figures": [["standard error", 0.0002]],
    }
    return record | more


def bins(side=8):
    """Bins of a square of which the left half holds twice as many samples as expected."""
    step = 1 / side
    return [[i * step, (i + 1) * step, j * step, (j + 1) * step, 100, 0.5, 200 if i < side / 2 else 100]
            for i in range(side) for j in range(side)]


def checks():
    good = [check(kind, f"{bsdf}/{example}/{face} {angle}°/{kind}")
            for bsdf in ("Lambertian", "GgxConductor") for example in ("alpha 0.1", "eta 1/1.5")
            for face in ("front", "back") for angle in (0, 60) for kind in ("integral", "chi_square", "jacobian")]
    scene = [check("mean", f"furnace_sphere/{way}/{channel}") for way in ("bsdf", "light", "mis 1,1 power=2")
             for channel in ("red", "green", "blue")]
    return good + scene + [
        check("chi_square", "GgxConductor/alpha 1/front 60°/chi_square", "fail", "pass", bins=bins(), p_value=0,
              reason="of 64 bins, the one around (0.1, 0.2, 0.97) holds 200 samples, expected 100 " + HOSTILE,
              diagnosis="observed/expected = 2 for x < 0.5: a factor?"),
        check("mean", "light/SphereLight/far", "inconclusive", "pass", advice="ask for more samples"),
        check("mean", "control/lambertian, density without 1/pi", "fail", "fail"),
        check("mean", "sun_and_sidewalk/coin flip", "inconclusive", "inconclusive"),
        check("variance_ratio", "small_light/bsdf over mis", estimate=3.0, interval_low=2.5, interval_high=3.5),
        check("calibration", "calibration/coverage/skewed", estimate=0.9991, figures=[["at least", 0.99], ["at most", 1]]),
    ]


def measurements():
    axis = {"label": "samples", "log": True}
    points = [1, 10, 100, 1000]
    fall = [1 / x for x in points]
    yield from ({"format": "plumbline.speed/1", "scene": "veach", "strategy": strategy, "heuristic": "", "sampler": "independent",
                 "spp": n, "seconds": 0.01 * n, "rays": 1000 * n, "rel_mse": 1 / n, "rel_mse_low": 0.8 / n,
                 "rel_mse_high": 1.25 / n, "replicates": 8} for strategy in ("bsdf", "mis") for n in (1, 4, 16, 64))
    yield {"format": "plumbline.ray_cost/1", "scene": "cornell", "rays": "as rendered", "occluded_fraction": 0.375, "width": 16,
           "count": 100000, "intersect_ns": 120, "occluded_ns": 90, "ratio": 0.75, "ratio_low": 0.7, "ratio_high": 0.8}
    for name, measured in (("Cornell box, equal error", 0.005), ("Two threads over one", 0.02)):
        yield {"format": "plumbline.bar/1", "name": name, "unit": "relMSE × s", "at_least": False, "limit": 0.0065,
               "measured": measured, "low": 0.9 * measured, "high": 1.1 * measured, "indicative": False,
               "comparison": "another renderer: 0.068", "note": "16 replicates"}
    yield {"format": "plumbline.stability/1", "bsdf": "GgxConductor/alpha 0.1", "function": "eval", "points": 10000, "error": 2e-6,
           "tolerance": 0.001, "place": "wo (0, 0, 1), wi (1, 0, 0)", "ill_conditioned": 3, "ill_conditioned_error": 0.125,
           "condition": 3e5, "ill_conditioned_place": "wo (1, 0, 0), u (0, 0.75)"}
    yield {"format": "plumbline.causes/1", "set": "first", "seed": 1, "twins": [
        {"name": "ggx/pdf half", "fault": "pdf has a factor of 1/2", "expected": "constant", "named": "constant", "found": True},
        {"name": "ggx/frame", "fault": "any tangent", "expected": "tangent frame", "named": "shifted", "found": True}]}
    yield {"format": "plumbline.figure/1", "group": "Integrals with known answers", "title": "Error against samples",
           "caption": "The dashed line is exact.", "x_axis": axis, "y_axis": {"label": "error", "log": True}, "series": [
               {"name": "mis", "style": "points", "x": points, "y": fall, "low": [0.8 * y for y in fall], "high": [1.2 * y for y in fall]},
               {"name": "exact", "style": "dashed", "x": points, "y": fall, "low": [], "high": []}]}
    yield {"format": "plumbline.table/1", "group": "Faults put in", "title": "Mutants", "caption": "Larger is better.",
           "columns": ["part", "seen"], "rows": [["verify", "98 %"], ["renderer", "97 %"]]}
    yield {"format": "plumbline.environment/1", "version": "1.0.0", "commit": "0123456789abcdef", "dirty": True,
           "compiler": "g++ 12", "flags": "Release -O3", "cpu": "a processor", "cores": 2, "system": "Linux",
           "load_average": 0.5, "time": "2026-02-28T12:00:00Z", "libraries": {"embree": "3.13.5"}}


def render(command, directory, scene, name):
    for strategy in ("bsdf", "mis"):
        stem = directory / f"{name}.{strategy}"
        subprocess.run([command, "render", scene, "--strategy", strategy, "--spp", "4", "--size", "24x18", "--threads", "1",
                        "-o", f"{stem}.exr", "--json", f"{stem}.json"], check=True, stdout=subprocess.DEVNULL)


def make_page(directory):
    """Writes results and their page below a directory; the page's path."""
    command = os.environ["PLUMBLINE"]
    results = pathlib.Path(directory) / "results"
    results.mkdir()
    with open(results / "all.jsonl", "w", encoding="utf-8") as lines:
        for record in (*checks(), *measurements()):
            lines.write(json.dumps(record) + "\n")
    scenes = pathlib.Path(__file__).parents[2] / "bench" / "scenes"
    render(command, results, str(scenes / "veach.xml"), "veach")
    render(command, results, "furnace_sphere", "furnace_sphere")
    page = pathlib.Path(directory) / "page.html"
    made = subprocess.run([command, "report", str(results), "-o", str(page)], stdout=subprocess.DEVNULL, check=False)
    if made.returncode != 1:  # two checks are not as they should be
        raise RuntimeError(f"plumbline report returned {made.returncode}")
    return page

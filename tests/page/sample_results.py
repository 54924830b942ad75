"""A small results directory that has something for every view of the page, and two rendered scenes."""

import datetime
import json
import os
import pathlib
import random
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
           "columns": ["part", "seen", *(f"seen after {n} seconds" for n in range(8))],
           "rows": [["verify", "98 %", *8 * ["9 %"]], ["renderer", "97 %", *8 * ["9 %"]]]}
    yield {"format": "plumbline.environment/1", "version": "1.0.0", "commit": "0123456789abcdef", "dirty": True,
           "compiler": "g++ 12", "flags": "Release -O3", "cpu": "a processor", "cores": 2, "system": "Linux",
           "load_average": 0.5, "time": "2026-02-28T12:00:00Z", "libraries": {"embree": "3.13.5"}}


NIGHTS = 60
STEP, DRIFT, MISSING, ODD = 40, (20, 29), 10, 50  # nights of the history in which something happens


def night(index):
    day = datetime.date(2026, 1, 1) + datetime.timedelta(days=index)
    status = "timed out" if index == 5 else "skipped" if index % 7 == 3 else "passed"
    return {"run": index + 1, "time": f"{day}T02:00:00Z", "commit": f"{index // 3 + 1:02d}" + 38 * "c", "dirty": index == 7, "sources": "ab",
            "checks": 4000, "unexpected": int(index == 20), "failed_parts": int(index == 5), "skipped_parts": int(index % 7 == 3),
            "gate_runs": 4, "failing_gate_runs": int(index == 20), "parts": [
                {"name": "gate", "status": "passed", "seconds": 2880.5, "note": ""},
                {"name": "benchmarks", "status": "passed", "seconds": 180, "note": ""},
                {"name": "mutants", "status": status, "seconds": 0 if status == "skipped" else 4500, "note": ""}]}


def change(nights, first, last, before, after, **more):
    ratio = after / before - 1
    return {"drift": first != last, "regression": after > before, "first_night": first, "last_night": last,
            "commit_before": nights[first - 1]["commit"], "commit_first": nights[first]["commit"], "commit_last": nights[last]["commit"],
            "before": before, "after": after, "relative": ratio, "low": ratio - 0.01, "high": ratio + 0.01,
            "means_p_value": 1e-6, "distribution_p_value": 2e-5} | more


def tracked(name, levels, noise, changes=(), odd=(), **more):
    median = [None if i == MISSING else level * (1 + noise(0.01)) for i, level in enumerate(levels)]
    spread = [(m and m * 0.99, m and m * 1.01) for m in median]
    return {"name": name, "unit": "ns", "counter": False, "lower_is_better": True, "median": median, "low": [low for low, _ in spread],
            "high": [high for _, high in spread], "changes": list(changes), "odd_nights": list(odd)} | more


def counted(name, values, changes=()):
    return {"name": name, "unit": "rays", "counter": True, "lower_is_better": True, "median": values, "low": values, "high": values,
            "changes": list(changes), "odd_nights": []}


def sequence(subject, verdict, scale, restart, **more):
    bound = [None if i == MISSING else scale / (i - (restart if i >= restart else 0) + 1) ** 0.5 for i in range(NIGHTS)]
    return {"check": "mean", "subject": subject, "verdict": verdict, "nights": NIGHTS - restart, "tolerance": 0.01, "bound": bound,
            "evidence": NIGHTS * [None], "reason": ""} | more


def history():
    """60 nights with 40 numbers: a step, a drift, a counter that changed, a check that was refuted, a seed that failed."""
    gauss = random.Random(1).gauss
    noise = lambda sigma: gauss(0, sigma)
    nights = [night(i) for i in range(NIGHTS)]
    flat = [50 + 0 * i for i in range(NIGHTS)]
    step = [100 if i < STEP else 104 for i in range(NIGHTS)]
    drift = [80 - 0.8 * min(max(i - DRIFT[0] + 1, 0), 10) for i in range(NIGHTS)]
    odd = [50 if i != ODD else 65 for i in range(NIGHTS)]
    numbers = [
        tracked("bsdf_cost/ggx_conductor/sample", step, noise, [change(nights, STEP, STEP, 100, 104)]),
        tracked("bsdf_cost/lambertian/eval", drift, noise, [change(nights, *DRIFT, 80, 72)]),
        tracked("ray_replay/cornell/shadow rays in packets of sixteen", odd, noise, odd=[ODD]),
        counted("speed/veach/mis/64 spp/rays", [10**9 if i < STEP else 10**9 + 7 for i in range(NIGHTS)],
                [change(nights, STEP, STEP, 10**9, 10**9 + 7, means_p_value=0, distribution_p_value=0)]),
        *(tracked(f"bsdf_cost/bsdf {i}/pdf", flat, noise) for i in range(30)),
        *(counted(f"speed/scene {i}/rays", [10**6 + i] * NIGHTS) for i in range(6))]
    sequences = [
        sequence("furnace_sphere/mis 1,1 power=2/red", "fail", 0.02, 0, reason="all nights together are 0.004 above the answer"),
        *(sequence(f"furnace_sphere/bsdf {i}/red", "pass", 0.01 + 0.002 * i, 30 if i % 2 else 0) for i in range(8)),
        sequence("Lambertian/default/front 0°/chi_square", "pass", 0, 0, check="chi_square", tolerance=None, bound=NIGHTS * [None],
                 evidence=[-0.1 * i for i in range(NIGHTS)])]
    failing = {"seed": 2**64 - 2, "commit": "07cccccccccc", "time": nights[20]["time"], "tests": 2500, "failures": ["Sphere.Mean/0"]}
    return {"format": "plumbline.history/1", "machine": "a processor x 2, g++ 12, Release -O3", "kind": "nightly", "nights": nights,
            "numbers": numbers, "sequences": sequences, "failing_gate_runs": [failing]}


def other_machine():
    """What another machine has: nothing yet but a night."""
    return {"format": "plumbline.history/1", "machine": "another processor x 4", "kind": "test", "nights": [night(0) | {"parts": []}],
            "numbers": [], "sequences": [], "failing_gate_runs": []}


def duet(part, ratio, half, pairs=16, a=(1000, 5), b=(1000, 5), **more):
    """Counters: rays and the hash of the result."""
    return {"format": "plumbline.duet/1", "part": part, "revision_a": "ab" * 20, "revision_b": "cd" * 20 + "+", "identical_code": False,
            "confidence": 0.9975, "ratio": ratio, "low": ratio - half, "high": ratio + half, "a_seconds": pairs * [0.001],
            "b_seconds": pairs * [0.001 * ratio], "counters_a": {"rays": a[0], "result": a[1]},
            "counters_b": {"rays": b[0], "result": b[1]}} | more


def duets():
    """A part that became slower, one that did not, one that is not known, and one of which rays and results alone differ."""
    return [duet("bsdf-sample/ggx_conductor", 1.031, 0.004), duet("render/mis", 1.001, 0.003), duet("verify/mean", 0.99, 0.08),
            duet("shadow-rays", 1, 0, pairs=0, b=(1010, 2**64 - 1))]


def render(command, directory, scene, name):
    for strategy in ("bsdf", "mis"):
        stem = directory / f"{name}.{strategy}"
        subprocess.run([command, "render", scene, "--strategy", strategy, "--spp", "4", "--size", "24x18", "--threads", "1",
                        "-o", f"{stem}.exr", "--json", f"{stem}.json"], check=True, stdout=subprocess.DEVNULL)


def make_page(directory, nights=True):
    """Writes results, with a history of nights or without, and their page below a directory; the page's path."""
    command = os.environ["PLUMBLINE"]
    results = pathlib.Path(directory) / "results"
    results.mkdir()
    with open(results / "all.jsonl", "w", encoding="utf-8") as lines:
        for record in (*checks(), *measurements(), *([history(), other_machine(), *duets()] if nights else [])):
            lines.write(json.dumps(record) + "\n")
    scenes = pathlib.Path(__file__).parents[2] / "bench" / "scenes"
    render(command, results, str(scenes / "veach.xml"), "veach")
    render(command, results, "furnace_sphere", "furnace_sphere")
    page = pathlib.Path(directory) / "page.html"
    made = subprocess.run([command, "report", str(results), "-o", str(page)], stdout=subprocess.DEVNULL, check=False)
    if made.returncode != 1:  # two checks are not as they should be
        raise RuntimeError(f"plumbline report returned {made.returncode}")
    return page

#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""One self-contained page of a run: a summary, map and path in 3-D, figures, all numbers.

  scripts/draw_run.py RESULT                          writes RESULT/run.html, and the figures as
                                                      SVG, PDF and PNG into RESULT/figures
  scripts/draw_run.py RESULT --evaluation EVALUATION  with what trajlo_evaluate found about it
  scripts/draw_run.py RESULT --output PAGE --points 200000
                                                      a smaller page, in another folder
RESULT is the output folder of trajlo_run; of an interrupted or lost run, what is there is shown.
The page needs no network; a browser with WebGL 2 turns the map. Needs Debian's python3-numpy,
python3-scipy, python3-matplotlib, python3-jinja2, python3-yaml and libjs-three.
"""
import argparse
import pathlib
import sys

import yaml

from trajlo_report import (figures_evaluation, figures_map, figures_run, files, names, page,
                           run_data, run_summary, theme, view, view_cloud)

MAP_CAPTION = "Map and path from above, from the front and from the side, on one scale"


def draw_figures(run, folder, config):
    """The figures of the run itself."""
    ceiling = view_cloud.ceiling_cut(run.cloud.points, run.positions) if run.cloud else None
    theme.save(figures_map.draw_thumbnail(run, ceiling), folder / "thumbnail", ("png",), dpi=140)
    caption = f"{MAP_CAPTION}; {run.frame.text}."
    if ceiling is not None:
        caption += f" From above, what is higher than {ceiling:.1f} m is left out."
    figures = [{"path": theme.save(figures_map.draw_views(run, ceiling), folder / "map",
                                   ("png", "svg", "pdf"), dpi=170)[0],
                "caption": caption, "width": 1080}]
    sigma_m = config.get("expert", {}).get("lost", {}).get("degenerate_sigma_m")
    degenerate = 1.0 / sigma_m**2 if sigma_m else None
    path = theme.save(figures_run.draw_windows(run, degenerate), folder / "windows", dpi=170)[0]
    said = "Red: flagged. " if run.flags else ""
    figures.append({"path": path, "width": 1080, "caption": f"Over time. {said}Times are means over "
                    "0.5 s."})
    return figures


def title_of(run_json, result):
    """What was recorded, for people."""
    inputs = run_json.get("input", {}).get("paths") or []
    return ", ".join(names.title(pathlib.Path(path).name) for path in inputs) or str(result)


def read_config(result):
    """The text of config.yaml, and its options."""
    file = result / "config.yaml"
    if not file.is_file():
        return "there is no config.yaml\n", {}
    text = file.read_text()
    options = yaml.safe_load(text)
    return text, options if isinstance(options, dict) else {}


def contents(arguments, output):
    """Draws, and returns what the page shows."""
    text, options = read_config(arguments.result)
    estimates = files.read_evaluation(arguments.evaluation)[1] if arguments.evaluation else []
    run_json = {}
    if (arguments.result / "run.json").is_file():
        run_json = files.read_json(arguments.result / "run.json")
    run, missing, shown, figures = None, [], None, []
    try:
        run = run_data.load(arguments.result, estimates, arguments.points)
    except files.ReportError as error:
        missing, estimates = [f"{error}."], []
    if estimates and run.estimate is None:
        raise files.ReportError(f"{arguments.evaluation} is the evaluation of another trajectory "
                                f"than that in {arguments.result}")
    folder = output / "figures"
    folder.mkdir(parents=True, exist_ok=True)
    theme.apply()
    if run is not None:
        missing = run.missing
        figures = draw_figures(run, folder, options)
        unavailable = view.missing_library()
        if unavailable:
            missing.append(unavailable)
        else:
            shown = view.embedded(run)
    return {"title": arguments.title or title_of(run_json, arguments.result),
            "verdict": run_summary.verdict(run_json),
            "ended_well": run_json.get("exit", {}).get("code") in (0, 3),
            "facts": run_summary.facts(run_json, run), "warnings": run_json.get("warnings", []),
            "missing": missing, "view": shown, "figures": figures, "estimates": estimates,
            "evaluation_figures": figures_evaluation.draw_all(estimates, folder, dpi=170),
            "understood_as": run_json.get("input", {}).get("understood_as", []),
            "config": text, "numbers": page.flatten(run_json)}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("result", type=pathlib.Path, help="the output folder of trajlo_run")
    parser.add_argument("--evaluation", type=pathlib.Path, help="output folder of trajlo_evaluate")
    parser.add_argument("--output", type=pathlib.Path, help="the folder to write; default: RESULT")
    parser.add_argument("--points", type=int, default=view_cloud.BUDGET,
                        help="the most points in the 3-D view; default: %(default)s")
    parser.add_argument("--title", help="in place of the recording's name")
    arguments = parser.parse_args()
    output = arguments.output or arguments.result
    if not arguments.result.is_dir():
        sys.exit(f"draw_run.py: {arguments.result} is not a folder")
    if not any((arguments.result / name).is_file() for name in ("run.json", "trajectory.tum")):
        sys.exit(f"draw_run.py: {arguments.result} holds no result of trajlo_run (run.json)")
    if arguments.points < 1:
        parser.error("--points must be at least 1")
    try:
        shown = contents(arguments, output)
    except files.ReportError as error:
        sys.exit(f"draw_run.py: {error}")
    file = output / "run.html"
    files.write_atomically(file, page.render("run.html", **shown))
    figures = len(shown["figures"]) + len(shown["evaluation_figures"])
    print(f"{file}: {file.stat().st_size / 1e6:.1f} MB, {figures} figures. {shown['verdict']}")


if __name__ == "__main__":
    main()

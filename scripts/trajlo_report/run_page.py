# SPDX-License-Identifier: MIT
"""The page of a run, and its figures."""
import pathlib

from trajlo_report import (figures_evaluation, figures_map, figures_run, files, names, page,
                           run_data, run_summary, theme, view, view_cloud)

MAP_CAPTION = "Map and path from above, from the front and from the side, on one scale"


def draw_figures(run, folder, formats):
    """The figures of the run itself."""
    ceiling = view_cloud.ceiling_cut(run.cloud.points, run.positions) if run.cloud else None
    theme.save(figures_map.draw_thumbnail(run, ceiling), folder / "thumbnail", ("png",), dpi=140)
    caption = f"{MAP_CAPTION}; {run.frame.text}."
    if ceiling is not None:
        caption += f" From above, what is higher than {ceiling:.1f} m is left out."
    # In a page, points of a map are smaller as a picture.
    path = theme.save(figures_map.draw_views(run, ceiling), folder / "map",
                      sorted(formats, key=lambda kind: kind != "png"), dpi=170)[0]
    figures = [{"path": path, "caption": caption, "width": 1080}]
    path = theme.save(figures_run.draw_windows(run), folder / "windows",
                      formats, dpi=170)[0]
    said = "Red: flagged. " if run.flags else ""
    figures.append({"path": path, "width": 1080, "caption": f"Over time. {said}Times are means over "
                    "0.5 s."})
    return figures


def title_of(run_json, result):
    """What was recorded, for people."""
    inputs = run_json.get("input", {}).get("paths") or []
    return ", ".join(names.title(pathlib.Path(path).name) for path in inputs) or str(result)


def read_config(result):
    file = result / "config.yaml"
    return file.read_text() if file.is_file() else "there is no config.yaml\n"


def contents(result, output, evaluation, title, points, formats):
    """Draws, and returns what the page shows."""
    estimates = files.read_evaluation(evaluation)[1] if evaluation else []
    run_json = {}
    if (result / "run.json").is_file():
        run_json = files.read_json(result / "run.json")
    run, missing, shown, figures = None, [], None, []
    try:
        run = run_data.load(result, estimates, points)
    except files.ReportError as error:
        missing, estimates = [f"{error}."], []
    if estimates and run.estimate is None:
        raise files.ReportError(f"{evaluation} is the evaluation of another trajectory than that "
                                f"in {result}")
    folder = output / "figures"
    files.make_folder(folder)
    theme.apply()
    if run is not None:
        missing = run.missing
        figures = draw_figures(run, folder, formats)
        unavailable = view.missing_library()
        if unavailable:
            missing.append(unavailable)
        else:
            shown = view.embedded(run)
    return {"title": title or title_of(run_json, result),
            "verdict": run_summary.verdict(run_json),
            "ended_well": run_json.get("exit", {}).get("code") in (0, 3),
            "facts": run_summary.facts(run_json, run), "warnings": run_json.get("warnings", []),
            "missing": missing, "view": shown, "figures": figures, "estimates": estimates,
            "evaluation_figures": figures_evaluation.draw_all(estimates, folder, dpi=170,
                                                               formats=formats),
            "understood_as": run_json.get("input", {}).get("understood_as", []),
            "config": read_config(result), "numbers": page.flatten(run_json)}


def write(result, output, evaluation=None, title="", points=view_cloud.BUDGET,
          formats=theme.FORMATS):
    """Writes run.html, and the figures in these formats, into `output`; returns the page and what
    it shows. Throws ReportError."""
    shown = contents(result, output, evaluation, title, points, formats)
    file = output / "run.html"
    files.write_atomically(file, page.render("run.html", **shown))
    return file, shown

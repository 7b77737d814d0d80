# SPDX-License-Identifier: MIT
"""All figures of an evaluation."""
from trajlo_report import evaluated, figures_errors, figures_path, files, theme

FIGURES = {
    "trajectory": (figures_path.draw_planes, "Truth and estimates in three planes, aligned"),
    "error_on_path": (figures_path.draw_error_on_path, "Translation error along the path"),
    "over_time": (figures_errors.draw_over_time, "Position and errors over time"),
    "error_components": (figures_errors.draw_error_components,
                         "Error of the position by component"),
    "error_distribution": (figures_errors.draw_distribution, "Share of poses below an error"),
    "kitti_lengths": (figures_errors.draw_kitti_lengths, "KITTI's relative errors by length"),
}


def draw_all(estimates, folder, dpi=250, width_in=theme.COLUMN_IN, formats=theme.FORMATS):
    """Draws what there is to draw into `folder`; returns the paths of the first format, with
    captions and widths for a page."""
    files.make_folder(folder)
    drawn = []
    if not evaluated.drawable(estimates):
        return drawn
    theme.apply()
    for name, (function, caption) in FIGURES.items():
        figure = function(estimates, width_in)
        if figure:
            paths = theme.save(figure, folder / name, formats, dpi=dpi)
            drawn.append({"path": paths[0], "caption": caption, "width": int(width_in * 140)})
    return drawn

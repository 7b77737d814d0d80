# SPDX-License-Identifier: MIT
"""Figures and self-contained HTML pages from what the programs write.

  files        reads trajectories, maps, statistics and evaluations
  run_data     all of one run in one frame (frames)
  theme        colours, sizes and saving, the same for all figures
  figures_*    functions that draw on the axes or return a figure
  view         the 3-D view of a run: what is in it (view_cloud, view_path), how it is packed
               (view_arrays), and the code that draws it in the browser (view/*.js)
  run_summary, comparison_words   conclusions in sentences
  names        names for people
  page         HTML with everything inside
  run_page     the page of a run
"""

# SPDX-License-Identifier: MIT
"""Figures and self-contained HTML pages from what the programs write.

  files        reads trajectories, maps, statistics and evaluations
  theme        colours, sizes and saving, the same for all figures
  figures_*    functions that draw on the axes or return a figure
  page         HTML with everything inside
"""

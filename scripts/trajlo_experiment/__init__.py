# SPDX-License-Identifier: MIT
"""Research experiments: what varies, over which recordings, and what came of it.

  factors      what varies: a key, several keys together, or named sets of options
  designs      which combinations are tried
  experiment   what an experiment file says
  points       its settings and recordings, as runs for trajlo_batch
  table        results.csv: a row a run with what varied and every metric
  analysis     errors relative to a reference, ranks with confidence, Pareto fronts
  findings     rows, errors, factors and marks, as all figures look at them
  effects      what each factor does to the error
  conclusion   what was found, in sentences
  figures_*    figures for papers
  experiment_report  one self-contained page
"""

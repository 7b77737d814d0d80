# SPDX-License-Identifier: MIT
"""Batches of runs: a suite is sequences times configurations, Snakemake does the work.

  suite        what a suite file says
  plan         the runs of a suite: their folders, what identifies them, which are done
  workflow     Snakemake and the progress bar
  steps        what a job does: simulate, run, evaluate, draw (python3 -m trajlo_batch STEP FILE)
  results      what came out, a row a run
  published    the numbers of a paper
  tables       tables of results, with the best marked
  batch_report one page about everything
"""

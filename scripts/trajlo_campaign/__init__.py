# SPDX-License-Identifier: MIT
"""Runs trajlo_run on recordings with random combinations of faults, and judges how each run ends.

  scenes             the eight short recordings
  draw               which scene, format and faults a run has: by seed and number alone
  simulator_faults   what goes wrong before a scan is recorded, as trajlo_simulate does it
  stamp_faults, point_faults, file_faults   damage to a recording
  scan_folder, message_file   a recording that faults can edit
  execute            a process with limits
  truth, flags       errors and flags pose by pose
  judge              how a run ended
  report             table, CSV and page
"""

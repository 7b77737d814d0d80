# SPDX-License-Identifier: MIT
"""Everything that a suite says is shown to the programs before the first run: what they refuse ends
the batch while nothing is lost."""
import subprocess

from trajlo_batch import suite_files
from trajlo_batch.steps import flags
from trajlo_batch.yaml_lines import SuiteError


def settings_flag(values):
    return [f"--set={','.join(f'{key}={value}' for key, value in values.items())}"] if values else []


def ask(suite, command, what, refusals=None):
    """What a program prints; SuiteError with its refusal, if it ends with one of these codes."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError as error:
        raise SuiteError(f"{command[0]} is missing; build it with scripts/build.sh") from error
    if done.returncode and (refusals is None or done.returncode in refusals):
        said = [line for line in done.stderr.strip().splitlines()
                if not line.startswith("(")]  # (trajlo_run --help shows examples)
        raise SuiteError(f"{suite.file}: {what}: " + "\n".join(said))
    return done.stdout


def effective_options(places, suite, configuration, sequence):
    """All options of a run as trajlo_run understands them, the files and the settings."""
    files = suite_files.configs(places, suite, sequence, configuration)
    values = suite_files.located(places, suite, {**sequence.settings, **configuration.settings})
    command = [places.program("trajlo_run"), "--show_config", "--show_expert_config",
               "--input=recording", "--output=result", f"--threads={suite.threads}",
               *flags(suite_files.located(places, suite, sequence.run)), *settings_flag(values)]
    there = [str(path) for path in files if path.exists()]  # others are missing with their data
    command += [f"--config={','.join(there)}"] if there else []
    text = ask(suite, command, f"the configuration {configuration.name} on {sequence.name} is "
                               "refused")
    return text, [str(path) for path in files], values


def scenario_parameters(places, suite, sequence):
    """All parameters of a simulated sequence: {key: text}."""
    command = [places.program("trajlo_simulate"), f"--scenario={sequence.scenario}",
               "--list_parameters", f"--duration_s={sequence.duration_s}",
               *settings_flag(sequence.parameters)]
    text = ask(suite, command, f"the sequence {sequence.name} is refused")
    lines = (line.partition("=") for line in text.splitlines())
    return {key: value for key, _, value in lines}


def check_evaluation(places, suite, sequence):
    """Wrong flags are refused before the files are looked for, which has another exit code."""
    values = suite_files.located(places, suite, sequence.evaluate)
    values.pop("kitti_calib", None)
    if values:
        ask(suite, [places.program("trajlo_evaluate"), "estimate", "--truth=truth",
                    "--output=evaluation", "--names=estimate", "--report=false", *flags(values)],
            f"evaluate of {sequence.name} is refused", refusals=(1,))


def check_lidars(suite, configuration, sequence, parameters):
    simulated = {key.partition(".")[0] for key in parameters if key.startswith("lidar")}
    count = len(simulated or sequence.topics or sequence.recording)
    if count and max(configuration.lidars, default=0) >= count:
        raise SuiteError(f"{suite.file}: the configuration {configuration.name} asks for LiDAR "
                         f"{max(configuration.lidars)}, counted from 0, and {sequence.name} has "
                         f"{count}")


def check_pairs(places, suite):
    """Throws SuiteError; asks no program twice for the same."""
    asked = {}
    for configuration, sequence in suite.pairs:
        simulated = str((sequence.scenario, sequence.duration_s, sequence.parameters))
        if simulated not in asked:
            asked[simulated] = (scenario_parameters(places, suite, sequence) if sequence.scenario
                                else {})
        if str(sequence.evaluate) not in asked:
            asked[str(sequence.evaluate)] = check_evaluation(places, suite, sequence)
        check_lidars(suite, configuration, sequence, asked[simulated])

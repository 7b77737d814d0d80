# SPDX-License-Identifier: MIT
"""results.csv, the figures, and one self-contained page about an experiment."""
import math
import re

from trajlo_batch import command_line, results, tables
from trajlo_batch.batch_report import about_outdated, summary
from trajlo_experiment import analysis, conclusion, figures, figures_tradeoff, table
from trajlo_experiment.factors import level_text
from trajlo_experiment.findings import Findings
from trajlo_report import page
from trajlo_report.files import to_csv, write_atomically

BEST = 12  # settings of the table
NUMBER = re.compile(r"\b\d+(\.\d+)?(e[+-]\d+)?(?= (m|s|%|°))")
RUN_COLUMNS = ("row", "sequence", "result", "ate_rmse_m", "ate_rotation_rmse_deg", "rpe_1m_rmse_m",
               "rpe_10m_rmse_m", "cpu_ms_per_data_second", "iterations_per_window", "inlier_share",
               "share_flagged")


def text_of(value, digits):
    return "×" if math.isinf(value) else "–" if math.isnan(value) else f"{value:.{digits}f}"


def levels_of(findings, row):
    return [level_text(row[factor.name]) if row[factor.name] is not None else "–"
            for factor in findings.study.factors]


def signs_of(findings, point, group):
    """Those that tables of batches have at values in doubt."""
    rows = [row for row in findings.rows if (row["point"], row["group"]) == (point, group)]
    unsure = tables.FROM_TRUTH.fullmatch(findings.metric) and any(
        row["evaluation_warnings"] for row in rows)
    return (f" {tables.DOUBT}" if any(map(results.in_doubt, rows)) else "") + (
        f" {tables.UNSURE}" if unsure else "")


def group_cell(findings, ranked, group):
    """Median over the seeds, with what is behind it."""
    errors = [findings.multiplier * error for error in ranked.errors[group]]
    failed = sum(map(math.isinf, errors))
    return {"text": findings.text(analysis.median(errors))
            + signs_of(findings, ranked.point, group)
            + (f" ({failed} ×)" if failed and failed < len(errors) else ""),
            "note": ", ".join(map(findings.text, errors))}


def best_settings(findings):
    """The best settings and the marked ones, side by side on all scenarios."""
    row_of = {row["point"]: row for row in findings.rows}
    lines = []
    for place, ranked in enumerate(findings.ranked(), 1):
        row = row_of[ranked.point]
        if place > BEST and not row["marks"]:
            continue
        lines.append({
            "rank": place, "levels": levels_of(findings, row), "marks": row["marks"],
            "score": text_of(ranked.score, 3),
            "interval": f"{text_of(ranked.low, 2)} to {text_of(ranked.high, 2)}",
            "best_share": text_of(100 * ranked.best_share, 0), "failed": ranked.failed,
            "groups": [group_cell(findings, ranked, group) for group in findings.groups]})
    return lines


def front_lines(findings):
    """The settings of each scenario's Pareto front, numbered as in the figure."""
    row_of = {row["point"]: row for row in findings.rows}
    for group in findings.groups:
        names, costs, errors, front = figures_tradeoff.tradeoff(findings, group)
        for number, index in enumerate(front, 1):
            yield {"group": group, "number": number, "cost": f"{costs[index]:.0f}",
                   "error": findings.text(errors[index]) + signs_of(findings, names[index], group),
                   "levels": levels_of(findings, row_of[names[index]])}


def failure_lines(rows):
    """Why runs failed, and which; reasons that differ in their numbers only are one."""
    counts = {}
    for row in rows:
        if row["result"] in (results.FAILED, results.UNFINISHED) and not row["outdated"]:
            reason = NUMBER.sub("…", f"{row['result']}: {row['reason']}")
            counts.setdefault(reason, []).append(row["row"])
    return sorted(counts.items(), key=lambda item: -len(item[1]))


def remarks_of(row):
    """Why a run failed or is in doubt."""
    said = [f"outdated: {row['outdated']} changed since"] if row["outdated"] else []
    if row["result"] != results.OK or results.in_doubt(row):
        said.append(row["reason"])
    return "; ".join(text for text in (*said, row["evaluation_warnings"]) if text)


def run_values(row):
    """What the table of runs shows of one, with the signs at its result."""
    signs = (f" {tables.DOUBT}" if results.in_doubt(row) else "") + (
        f" {tables.UNSURE}" if row["evaluation_warnings"] else "")
    return [row.get(name) if name != "result" else row["result"] + signs for name in RUN_COLUMNS]


def run_lines(findings, rows):
    return [{"levels": levels_of(findings, row), "marks": row["marks"],
             "remarks": remarks_of(row), "failed": row["result"] != results.OK or row["outdated"],
             "values": run_values(row)} for row in rows]


SIGNS = {tables.DOUBT: "a run ended with exit code 3: a part of its input was damaged, left out or in "
         "doubt", tables.UNSURE: "trajlo_evaluate warns about the comparison with the truth"}


def sign_note(rows):
    """What the signs at values mean, as far as there are any."""
    shown = {tables.DOUBT: any(map(results.in_doubt, rows)),
             tables.UNSURE: any(row["evaluation_warnings"] for row in rows)}
    said = "; ".join(f"{sign}: {text}" for sign, text in SIGNS.items() if shown[sign])
    return f"{said}. The table of runs says which." if said else ""


DESIGNS = {"grid": "all combinations of the values", "one_at_a_time": "one factor at a time about "
           "a centre", "random": "random settings", "latin_hypercube": "a Latin hypercube",
           "sobol": "a Sobol sequence"}


def design_text(study):
    design = study.design
    text = DESIGNS.get(design.kind, design.kind.replace("_", " "))
    return f"{text}, {design.samples} samples, seed {design.seed}" if design.samples else text


def write_report(plan):
    """Writes results.csv, figures and report.html into the output folder; returns the rows."""
    output, study = plan.places.output, plan.suite
    if not plan.runs:
        return []
    rows = table.collect(plan)
    write_atomically(output / "results.csv", to_csv(rows))
    findings = Findings(study, rows)
    drawn = figures.draw_all(findings, output / "figures")
    programs = [(name, f"{program['version']} ({program['digest']})")
                for name, program in plan.programs.items()]
    shown = [name for name in RUN_COLUMNS if any(row.get(name) is not None for row in rows)]
    text = page.render(
        "experiment.html", title=study.title, study=study, summary=summary(rows),
        count=len(rows), design=design_text(study), recordings=len(study.base_sequences),
        findings=findings, best=best_settings(findings), front=list(front_lines(findings)),
        failures=failure_lines(rows), conclusions=conclusion.sentences(findings),
        warnings=[text for text in (*conclusion.warnings(plan), about_outdated(rows, "--report"))
                  if text],
        caution=conclusion.caution(findings), sign_note=sign_note(rows),
        figures=drawn, level_text=level_text,
        runs=run_lines(findings, rows), run_columns=RUN_COLUMNS, shown=shown, programs=programs,
        missing=plan.missing, text=study.file.read_text(),
        call=command_line.call_of("experiment", "experiments", study.file, plan.places))
    write_atomically(output / "report.html", text)
    return rows

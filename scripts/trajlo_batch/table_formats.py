# SPDX-License-Identifier: MIT
"""Tables as Markdown, LaTeX and CSV."""
import csv
import io


def heading(table, line):
    """Who made a line of a table: ours have a star where those of others stand beside them."""
    label = f"{line.label} *" if line.ours and not all(item.ours for item in table.lines) \
        else line.label
    return f"{label} ({line.sensors})" if line.sensors else label


def shown(cell):
    """For readers; programs take the x."""
    return cell.text.replace("x", "×")


def grid(table, show_cell, show_text):
    """The table as rows of texts, the heading first."""
    if table.transposed:
        rows = [["sequence", *(show_text(heading(table, line)) for line in table.lines)]]
        for index, column in enumerate(table.columns):
            rows.append([show_text(column), *(show_cell(line.cells[index])
                                              for line in table.lines)])
        return rows
    several = len({line.category for line in table.lines}) > 1
    rows = [[*(["category"] if several else []), "approach", *map(show_text, table.columns)]]
    for line in table.lines:
        rows.append([*([line.category] if several else []), show_text(heading(table, line)),
                     *map(show_cell, line.cells)])
    return rows


def markdown_cell(cell):
    text = f"<u>{shown(cell)}</u>" if cell.category_best else shown(cell)
    return f"**{text}**" if cell.best else text


def to_markdown(table):
    rows = grid(table, markdown_cell, lambda text: text.replace("*", r"\*").replace("|", r"\|"))
    lines = [f"**{table.caption}**", "", "| " + " | ".join(rows[0]) + " |",
             "|---|" + "---:|" * (len(rows[0]) - 1)]
    lines += ["| " + " | ".join(row) + " |" for row in rows[1:]]
    notes = [note.replace("*", r"\*") for note in table.notes]
    return "\n".join(lines + [""] + [f"- {note}" for note in notes]) + "\n"


LATEX = {"\\": r"\textbackslash{}", "_": r"\_", "%": r"\%", "&": r"\&", "#": r"\#", "$": r"\$",
         "{": r"\{", "}": r"\}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}",
         "…": r"\dots{}", "†": r"\textdagger{}", "×": r"$\times$"}


def latex_text(text):
    return "".join(LATEX.get(letter, letter) for letter in text)


def latex_cell(cell):
    text = latex_text(shown(cell))
    text = rf"\underline{{{text}}}" if cell.category_best else text
    return rf"\textbf{{{text}}}" if cell.best else text


def to_latex(table):
    """A floating table for the packages booktabs and graphicx."""
    rows = grid(table, latex_cell, latex_text)
    lines = [r"% \usepackage{booktabs, graphicx}", r"\begin{table*}[t]", r"\centering",
             rf"\caption{{{latex_text(table.caption)}}}",
             r"\resizebox{\textwidth}{!}{",
             rf"\begin{{tabular}}{{@{{}}l{'c' * (len(rows[0]) - 1)}@{{}}}}", r"\toprule"]
    for index, row in enumerate(rows):
        lines.append(" & ".join(row) + r" \\")
        new_category = not table.transposed and 0 < index < len(rows) - 1 and (
            table.lines[index - 1].category != table.lines[index].category)
        if index == 0 or new_category:
            lines.append(r"\midrule")
    lines += [r"\bottomrule", r"\end{tabular}}"]
    lines += [rf"\\ {{\footnotesize {latex_text(note)}}}" for note in table.notes]
    return "\n".join(lines + [r"\end{table*}"]) + "\n"


def to_csv(table):
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerows(
        grid(table, lambda cell: cell.text, lambda text: text))
    return stream.getvalue()

# SPDX-License-Identifier: MIT
"""Options as trajlo_run shows them."""


def flatten(tree, prefix=""):
    """Nested mappings as (dotted key, value)."""
    for key, value in tree.items():
        if isinstance(value, dict):
            yield from flatten(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}", value

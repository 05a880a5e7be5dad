"""Symbolic passes: from flat equations to a structured DAE of index one."""

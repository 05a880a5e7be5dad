"""The valve study of the ARTHuR report, sections 3 and 4: rotary against spool."""

"""Acausal, equation-based modelling of multi-domain systems, integrated by SUNDIALS IDA."""

"""Graph algorithms on plain integers and lists: no symbolic types, no recursion, near-linear work.

Equations and variables are numbered from 0; ``edges[equation]`` lists the variables that occur in the
equation.
"""

from arthur_acausal.graph.blt import blt as blt
from arthur_acausal.graph.blt import strongly_connected as strongly_connected
from arthur_acausal.graph.dulmage_mendelsohn import Conflict as Conflict
from arthur_acausal.graph.dulmage_mendelsohn import Decomposition as Decomposition
from arthur_acausal.graph.dulmage_mendelsohn import StructurallySingular as StructurallySingular
from arthur_acausal.graph.dulmage_mendelsohn import conflicts as conflicts
from arthur_acausal.graph.dulmage_mendelsohn import dulmage_mendelsohn as dulmage_mendelsohn
from arthur_acausal.graph.dummy_derivative import PRIORITIES as PRIORITIES
from arthur_acausal.graph.dummy_derivative import StateSelection as StateSelection
from arthur_acausal.graph.dummy_derivative import select_dummies as select_dummies
from arthur_acausal.graph.dummy_derivative import select_states as select_states
from arthur_acausal.graph.echelon import Echelon as Echelon
from arthur_acausal.graph.echelon import SparseRow as SparseRow
from arthur_acausal.graph.matching import augment as augment
from arthur_acausal.graph.matching import inverse as inverse
from arthur_acausal.graph.matching import matching as matching
from arthur_acausal.graph.matching import transpose as transpose
from arthur_acausal.graph.pantelides import PantelidesResult as PantelidesResult
from arthur_acausal.graph.pantelides import chains as chains
from arthur_acausal.graph.pantelides import pantelides as pantelides
from arthur_acausal.graph.signed_union import Outcome as Outcome
from arthur_acausal.graph.signed_union import SignedUnion as SignedUnion
from arthur_acausal.graph.signed_union import Union as Union
from arthur_acausal.graph.tearing import TearingResult as TearingResult
from arthur_acausal.graph.tearing import tear as tear

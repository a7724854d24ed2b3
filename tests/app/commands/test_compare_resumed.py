"""`equipoise compare --resume` and `--on`; other commands that spread pieces of work."""

import pickle
import subprocess
import sys

import pytest

from equipoise.app.runs.balance_series import run_series
from equipoise.app.runs.balancing import Goal, Limits
from equipoise.io.testbed.presets import read_preset
from equipoise.planning.manoeuvre.plan import Trials, Wish, planned
from equipoise.planning.sizing.case import Case
from equipoise.planning.sizing.sizing import sized
from equipoise.procedure.identification.identify import IdentifyOptions
from equipoise.procedure.identification.identify_runs import identify_runs
from tests.planning.manoeuvre.test_manoeuvre_space import *  # noqa: F403

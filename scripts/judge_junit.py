"""Reads a JUnit report with junitparser, and compares its numbers with what is in it."""

import sys

from junitparser import Failure, JUnitXml

report = JUnitXml.fromfile(sys.argv[1])
cases = [case for suite in report for case in suite]
failed = [case for case in cases if any(isinstance(each, Failure) for each in case.result)]
assert report.tests == len(cases) > 0, (report.tests, len(cases))
assert report.failures == len(failed) > 0, (report.failures, len(failed))
assert all(each.text and each.message for case in failed for each in case.result)

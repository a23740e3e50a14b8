"""SARIF: each finding once, with its rule, its level and its file."""

import json
import subprocess
import sys

from brdfguide import flags

from ..conftest import ROOT


def test_every_finding_is_a_result_with_its_rule():
    command = [sys.executable, "-m", "brdfguide", "inspect", "examples/rough_plastic.csv"]
    log, plain = (
        json.loads(subprocess.run([*command, form], cwd=ROOT, capture_output=True, text=True).stdout)
        for form in ("--sarif", "--json")
    )
    assert log["version"] == "2.1.0" and log["$schema"].endswith("sarif-2.1.0.json")
    run = log["runs"][0]
    rules = run["tool"]["driver"]["rules"]
    found = [*plain["data"]["findings"], *plain["findings"]]
    assert len(run["results"]) == len(found) > 5
    for result, finding in zip(run["results"], found, strict=True):
        assert rules[result["ruleIndex"]]["id"] == result["ruleId"] == finding.get("flag", finding["code"])
        assert rules[result["ruleIndex"]]["shortDescription"]["text"] == flags.FLAGS[result["ruleId"]].meaning
        assert result["message"]["text"].startswith(finding["text"]) and result["level"] in ("note", "warning", "error")
        where = result["locations"][0]["physicalLocation"]["artifactLocation"]
        assert where == {"uri": "examples/rough_plastic.csv"}

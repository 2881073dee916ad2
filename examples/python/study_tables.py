# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Prints the tables of the studies from the lines that measure-cases printed.

    build/bin/measure-cases 'efficiency/*/target' --seeds 24 >efficiency.jsonl
    python examples/python/study_tables.py efficiency.jsonl

    build/bin/measure-cases 'robustness/*' >robustness.jsonl
    build/bin/measure-cases 'sensors/bends/*' --seeds 10 >bends.jsonl
    build/bin/measure-cases 'check/*' --seeds 8 >check.jsonl
    build/bin/measure-cases 'efficiency/*/target' --method published --seeds 20 >table2.jsonl
    python examples/python/study_tables.py --paper table2.jsonl
    build/bin/measure-cases 'single/*' --seeds 20 >single.jsonl

Each study has its own table. Its columns are explained in study_efficiency.py, study_robustness.py, study_sensors.py,
study_check.py and study_single.py. --paper prints the efficiency study next to Tables 2 and 3 of Sur & Grédiac 2015
(study_paper.py).
"""

import argparse
import sys

import study_check
import study_efficiency
import study_paper
import study_robustness
import study_sensors
import study_single
from study_records import case_of, read_records

STUDIES = {
    "efficiency": study_efficiency,
    "robustness": study_robustness,
    "sensors": study_sensors,
    "check": study_check,
    "single": study_single,
}


def main(arguments=None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", metavar="FILE", help="lines of JSON that measure-cases printed")
    parser.add_argument("--paper", action="store_true", help="the tables of the paper, of efficiency cases")
    options = parser.parse_args(arguments)
    records = read_records(options.files)
    for name, study in STUDIES.items():
        of_study = [record for record in records if case_of(record)[0] == name]
        if of_study:
            (study_paper if options.paper and name == "efficiency" else study).print_table(of_study)
    return 0


if __name__ == "__main__":
    sys.exit(main())

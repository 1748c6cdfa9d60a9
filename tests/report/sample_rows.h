// A report by hand, for the tests of what is made of it.
#pragma once

#include <string>

#include "bakers/report/report.h"

namespace skybake::testing {

inline ReportRow sample_row(std::string variant, double time_ms, double error) {
    ReportRow row;
    row.asset = "air";
    row.family = "size";
    row.variant = std::move(variant);
    row.size = {64, 16};
    row.file_bytes = 1234;
    row.time_ms = time_ms;
    row.texel = {2 * error, error};
    row.lookup = {4 * error, 3 * error};
    return row;
}

inline AssetReport sample_report() {
    AssetReport report;
    report.name = "air";
    report.kind = "transmittance";
    report.reference = "a \"reference\" <finer> & slower";
    report.scale = "absolute";
    report.timing = "processor time";
    report.texel_points = 8;
    report.lookup_points = 16;
    report.repetitions = 5;
    report.rows = {sample_row("64x16", 0.5, 1e-3), sample_row("128x32, \"fine\"", 2, 1e-4),
                   sample_row("zero <0>", 4, 0)};
    report.rows[0].baseline = "the paper's & ours";
    report.rows[1].of_recipe = true;
    report.rows[1].on_time_front = report.rows[1].on_bytes_front = true;
    report.rows[2].size = {64, 32, 16};
    return report;
}

}  // namespace skybake::testing

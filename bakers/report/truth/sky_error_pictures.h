// Where on the sky each way to multiple scattering is wrong.
#pragma once

#include <string>
#include <vector>

#include "bakers/math/bake_options.h"
#include "bakers/report/report_files.h"
#include "bakers/report/truth/sky_truth_report.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct SkyErrorPictureOptions {
    std::vector<double> sun_zenith_degrees = {30, 89, 94};
    double camera_altitude_km = 0.5;
    int dome_pixels = 64;
};

// The name of the picture of a method: "sky_error_KEY.png".
std::string sky_error_picture_name(const SkyMethod& method);

// For each method but the last one PNG file: domes side by side, one for each sun, of the relative
// error in colours. Each pixel shows the channel with the largest error, relative to the reference
// or to 1e-3 of the channel's largest value, whichever is larger. Path tracing a whole dome takes
// too long: errors are against the last method, which is to be the most exact one. Errors as of
// png_bytes. Fewer files: the user has interrupted.
config::Outcome<std::vector<ReportFile>> sky_error_pictures(
    const SkyMedium& medium, const std::vector<MadeSkyMethod>& methods,
    const SkyErrorPictureOptions& options, int threads, Progress* progress);

}  // namespace skybake

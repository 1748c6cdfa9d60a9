// Pictures that show where on the sky each method of multiple scattering is wrong.
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

// Returns the name of a method's picture: "sky_error_KEY.png".
std::string sky_error_picture_name(const SkyMethod& method);

// Makes one PNG file for each method except the last. It shows the relative error as colours, on
// domes side by side, one for each sun. Each pixel shows the mean of the channels' errors,
// each relative to the reference or to 1e-3 of the channel's largest value, whichever is larger. The
// reference is the last method, which must be the most exact one, because path tracing a whole dome
// takes too long. Diagnostics are those of png_bytes. There are fewer files if the user has
// interrupted.
config::Outcome<std::vector<ReportFile>> sky_error_pictures(
    const SkyMedium& medium, const std::vector<MadeSkyMethod>& methods,
    const SkyErrorPictureOptions& options, int threads, Progress* progress);

}  // namespace skybake

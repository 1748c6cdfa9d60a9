// Where on the sky each way to multiple scattering is wrong.
#pragma once

#include <vector>

#include "bakers/math/progress.h"
#include "bakers/plot/picture.h"
#include "bakers/report/truth/sky_truth_report.h"

namespace skybake {

struct SkyErrorPictureOptions {
    std::vector<double> sun_zenith_degrees = {30, 89, 94};
    double camera_altitude_km = 0.5;
    int dome_pixels = 64;
};

// For each method but the last one picture: domes side by side, one a sun, of the relative error in
// colours. Path tracing a whole dome takes too long: errors are against the last method, which is
// to be the most exact one. Named "sky_error_KEY". Fewer pictures: the user has interrupted.
std::vector<PreviewPicture> sky_error_pictures(const SkyMedium& medium,
                                               const std::vector<MadeSkyMethod>& methods,
                                               const SkyErrorPictureOptions& options, int threads,
                                               Progress* progress);

}  // namespace skybake

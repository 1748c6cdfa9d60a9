#include "bakers/report/truth/sky_truth_report.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>

#include "bakers/light/sky_radiance.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "bakers/report/sweeps/sweep.h"

namespace skybake {

namespace {

// The cosine and the sine are exact at 90 and 0 degrees.
double cosine_of_degrees(double angle) { return cosine_of_pi(angle / 180); }
double sine_of_degrees(double angle) { return cosine_of_pi(std::fabs(90 - angle) / 180); }

// The directions of one sun, as indices into all directions.
struct SunGroup {
    double sun_zenith_degrees = 0;
    std::vector<std::size_t> directions;
    std::vector<double> shares;
};

std::vector<SunGroup> sun_groups(const std::vector<SkyTruthDirection>& directions) {
    std::vector<SunGroup> groups;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double sun = directions[i].sun_zenith_degrees;
        auto at = std::find_if(groups.begin(), groups.end(), [sun](const SunGroup& group) {
            return group.sun_zenith_degrees == sun;
        });
        if (at == groups.end()) at = groups.insert(groups.end(), {sun, {}, {}});
        at->directions.push_back(i);
    }
    for (SunGroup& group : groups) {
        std::vector<SkyTruthDirection> own;
        for (const std::size_t i : group.directions) own.push_back(directions[i]);
        group.shares = dome_shares(own);
    }
    return groups;
}

// Returns the interval that places[i] represents: it extends halfway to the neighbours, or to the
// ends. The places are ascending.
std::pair<double, double> interval_of(const std::vector<double>& places, std::size_t i, double low,
                                      double high) {
    return {i == 0 ? low : (places[i - 1] + places[i]) / 2,
            i + 1 == places.size() ? high : (places[i] + places[i + 1]) / 2};
}

std::size_t place_of(const std::vector<double>& values, double value) {
    return static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), value) -
                                    values.begin());
}

void sort_unique(std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

std::vector<SkyTruthDirection> directions_of(const std::vector<SkyTruth>& truth, int channels) {
    std::vector<SkyTruthDirection> directions;
    for (std::size_t i = 0; i < truth.size(); i += static_cast<std::size_t>(channels)) {
        directions.push_back(truth[i].direction);
    }
    return directions;
}

double quantile(const std::vector<double>& sorted, std::size_t tenths) {
    return sorted.empty() ? 0 : sorted[std::min(sorted.size() * tenths / 10, sorted.size() - 1)];
}

// Calculates figures of errors that are in the order of the truth.
SkyErrorFigures figures_of(const std::vector<double>& errors, const std::vector<SkyTruth>& truth,
                           const std::vector<SunGroup>& groups, int channels) {
    SkyErrorFigures figures;
    std::vector<double> relative;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        if (truth[i].radiance > 0) relative.push_back(std::fabs(errors[i] / truth[i].radiance));
    }
    std::sort(relative.begin(), relative.end());
    figures.median = quantile(relative, 5);
    figures.p90 = quantile(relative, 9);
    figures.max = quantile(relative, 10);
    for (const SunGroup& group : groups) {
        Spectrum rms{};
        for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
            double mean = 0;
            double square = 0;
            for (std::size_t j = 0; j < group.directions.size(); ++j) {
                const std::size_t at = group.directions[j] * static_cast<std::size_t>(channels) + c;
                mean += group.shares[j] * truth[at].radiance;
                square += group.shares[j] * errors[at] * errors[at];
            }
            rms[c] = mean > 0 ? std::sqrt(square) / mean : 0;
        }
        figures.dome_rms.push_back(rms);
    }
    return figures;
}

void mark_sky_front(std::vector<SkyErrorRow>& rows) {
    std::vector<CostAndError> choices;
    for (const SkyErrorRow& row : rows) choices.push_back({row.time_ms, row.error.median});
    const std::vector<bool> front = pareto_front(choices, kTimingNoise);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].on_front = front[i];
}

void set_ratios(std::vector<SkyErrorRow>& rows) {
    double cheapest = 0;
    for (const SkyErrorRow& row : rows) {
        if (row.time_ms > 0 && (cheapest == 0 || row.time_ms < cheapest)) cheapest = row.time_ms;
    }
    for (SkyErrorRow& row : rows) row.time_ratio = cheapest > 0 ? row.time_ms / cheapest : 0;
}

}  // namespace

std::optional<std::vector<MadeSkyMethod>> make_sky_methods(std::vector<SkyMethod> methods,
                                                           int repetitions, Progress* progress) {
    std::vector<MadeSkyMethod> made(methods.size());
    std::vector<std::function<void()>> jobs;
    std::vector<std::size_t> timed;
    for (std::size_t i = 0; i < methods.size(); ++i) {
        made[i].method = std::move(methods[i]);
        if (!made[i].method.takes_time()) continue;
        timed.push_back(i);
        jobs.emplace_back([&one = made[i]] {
            if (one.method.make) one.orders = one.method.make();
            if (one.method.make_whole) one.whole = one.method.make_whole();
        });
    }
    const double runs = static_cast<double>(jobs.size()) * repetitions;
    const auto before_each = [&](int round, std::size_t job) {
        if (progress == nullptr) return true;
        const std::size_t done = static_cast<std::size_t>(round) * jobs.size() + job;
        progress->advance("timing", static_cast<double>(done) / runs);
        return !progress->cancelled();
    };
    const std::vector<double> seconds = interleaved_medians(jobs, repetitions, before_each);
    if (seconds.size() != jobs.size()) return std::nullopt;
    for (std::size_t i = 0; i < timed.size(); ++i) {
        made[timed[i]].time_ms = std::round(seconds[i] * 1e9) / 1e6;  // the clock counts ns
    }
    return made;
}

AirRadiance air_radiance(const SkyMedium& medium, const MadeSkyMethod& made) {
    if (made.whole) return made.whole;
    const auto integrator = std::make_shared<const SkyIntegrator>(medium, made.orders.get());
    return [integrator](double altitude_km, const SunZenith& sun, const SkyDirection& direction) {
        const SkyRadiance sky = integrator->radiance(altitude_km, sun, direction);
        return sky.single + sky.multiple;
    };
}

std::vector<double> dome_shares(const std::vector<SkyTruthDirection>& directions) {
    std::vector<double> zeniths;
    for (const SkyTruthDirection& at : directions) zeniths.push_back(at.view_zenith_degrees);
    sort_unique(zeniths);
    std::vector<double> shares;
    for (const SkyTruthDirection& at : directions) {
        std::vector<double> azimuths;
        for (const SkyTruthDirection& other : directions) {
            if (other.view_zenith_degrees == at.view_zenith_degrees) {
                azimuths.push_back(other.azimuth_degrees);
            }
        }
        sort_unique(azimuths);
        const auto [upper, lower] =
            interval_of(zeniths, place_of(zeniths, at.view_zenith_degrees), 0, 90);
        const auto [begin, end] =
            interval_of(azimuths, place_of(azimuths, at.azimuth_degrees), 0, 180);
        shares.push_back((cosine_of_degrees(upper) - cosine_of_degrees(lower)) * (end - begin) /
                         180);
    }
    return shares;
}

std::vector<SkyTruth> by_direction(std::vector<SkyTruth> truth) {
    std::vector<SkyTruthDirection> directions;
    const auto place = [&directions](const SkyTruth& value) {
        return std::find(directions.begin(), directions.end(), value.direction) -
               directions.begin();
    };
    for (const SkyTruth& value : truth) {
        if (place(value) == std::ssize(directions)) directions.push_back(value.direction);
    }
    std::stable_sort(truth.begin(), truth.end(), [&](const SkyTruth& a, const SkyTruth& b) {
        return std::pair(place(a), a.channel) < std::pair(place(b), b.channel);
    });
    return truth;
}

std::vector<double> sky_radiances(const SkyMedium& medium, const MadeSkyMethod& made,
                                  const std::vector<SkyTruth>& truth, int threads) {
    const int channels = medium.air.channels;
    const std::vector<SkyTruthDirection> directions = directions_of(truth, channels);
    const AirRadiance air = air_radiance(medium, made);
    std::vector<double> radiances(truth.size());
    parallel_for(static_cast<int>(directions.size()), threads, [&](int i) {
        const SkyTruthDirection& at = directions[static_cast<std::size_t>(i)];
        const SunZenith sun = {cosine_of_degrees(at.sun_zenith_degrees),
                               sine_of_degrees(at.sun_zenith_degrees)};
        const SkyDirection view = sky_direction(sun, cosine_of_degrees(at.view_zenith_degrees),
                                                sine_of_degrees(at.view_zenith_degrees),
                                                cosine_of_degrees(at.azimuth_degrees));
        const Spectrum sky = air(at.altitude_km, sun, view);
        for (int channel = 0; channel < channels; ++channel) {
            const auto c = static_cast<std::size_t>(channel);
            radiances[static_cast<std::size_t>(i * channels + channel)] = sky[c];
        }
    });
    return radiances;
}

SkyErrorReport measure_sky_errors(const SkyMedium& medium,
                                  const std::vector<MadeSkyMethod>& methods,
                                  const std::vector<SkyTruth>& truth_in_any_order, int repetitions,
                                  int threads) {
    const std::vector<SkyTruth> truth = by_direction(truth_in_any_order);
    SkyErrorReport report;
    report.channels = medium.air.channels;
    report.repetitions = repetitions;
    const std::vector<SkyTruthDirection> directions = directions_of(truth, report.channels);
    const std::vector<SunGroup> groups = sun_groups(directions);
    report.directions = static_cast<int>(directions.size());
    for (const SunGroup& group : groups) {
        report.sun_zenith_degrees.push_back(group.sun_zenith_degrees);
    }
    std::vector<double> errors;
    for (const SkyTruth& value : truth) {
        errors.push_back(value.standard_error);
        if (!(value.radiance > 0)) ++report.black;
    }
    report.truth_error = figures_of(errors, truth, groups, report.channels);
    for (const MadeSkyMethod& made : methods) {
        errors = sky_radiances(medium, made, truth, threads);
        for (std::size_t i = 0; i < errors.size(); ++i) errors[i] -= truth[i].radiance;
        report.rows.push_back({made.method, made.time_ms, 0,
                               figures_of(errors, truth, groups, report.channels), false});
    }
    set_ratios(report.rows);
    mark_sky_front(report.rows);
    return report;
}

double joined(const Spectrum& channels, int count) {
    double squares = 0;
    for (int c = 0; c < count; ++c) {
        squares += channels[static_cast<std::size_t>(c)] * channels[static_cast<std::size_t>(c)];
    }
    return std::sqrt(squares / count);
}

MethodErrors method_errors(const SkyErrorReport& report) {
    MethodErrors errors;
    for (const SkyErrorRow& row : report.rows) {
        errors.push_back({row.method.key, {row.error.median, row.error.p90}});
    }
    return errors;
}

}  // namespace skybake

#include "bakers/io/manifest/examination.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace skybake {
namespace {

bool shows(const ReadableTexture& texture, const CaughtProbe& probe, const WrongLookup& wrong) {
    if (probe.value.size() != texture.channels || probe.tolerance.size() != texture.channels) {
        return false;
    }
    const std::vector<double> found = look_up_wrongly(texture, probe.lookups, wrong);
    for (std::size_t c = 0; c < found.size(); ++c) {
        if (std::abs(found[c] - probe.value[c]) > probe.tolerance[c]) return true;
    }
    return false;
}

}  // namespace

void check_catches(Examination& examination, const ReadableTexture& texture, int dimensions,
                   const std::vector<CaughtProbe>& probes,
                   const std::vector<std::string>& catches) {
    std::map<std::string, int> shown;  // number of probes; the fewest of all ways with one name
    for (const WrongLookup& wrong : wrong_lookups(texture.use, dimensions)) {
        const auto count = static_cast<int>(std::ranges::count_if(
            probes, [&](const CaughtProbe& probe) { return shows(texture, probe, wrong); }));
        const auto [entry, fresh] = shown.emplace(wrong.name, count);
        if (!fresh) entry->second = std::min(entry->second, count);
    }
    for (const std::string& name : catches) {
        const auto entry = shown.find(name);
        if (!examination.expect(entry != shown.end(), "catches",
                                fmt::format("{} is not a fault that probes can catch", name))) {
            continue;
        }
        examination.expect(entry->second >= kSeveralProbes, "catches",
                           fmt::format("{} probes detect {}, but {} or more must", entry->second,
                                       name, kSeveralProbes));
    }
}

void check_lookup(Examination& examination, const std::string& place,
                  const std::vector<double>& found, const std::vector<double>& value,
                  const std::vector<double>& tolerance) {
    if (!examination.expect(
            value.size() == found.size() && tolerance.size() == found.size(), "probe",
            fmt::format("the probe at {} does not have {} channels", place, found.size()))) {
        return;
    }
    bool holds = true;
    for (std::size_t i = 0; i < found.size(); ++i) {
        holds = holds && std::abs(found[i] - value[i]) <= tolerance[i];
    }
    examination.expect(
        holds, "probe",
        fmt::format("at {} the file gives ({}), but the manifest says ({}) ± ({})", place,
                    fmt::join(found, ", "), fmt::join(value, ", "), fmt::join(tolerance, ", ")));
}

}  // namespace skybake

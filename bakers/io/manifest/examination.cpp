#include "bakers/io/manifest/examination.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace skybake {
namespace {

// Long texts (the parameters) are not shown whole: the first line that differs says more.
std::string first_difference(const std::string& found, const std::string& wanted) {
    std::size_t begin = 0;
    std::size_t i = 0;
    while (i < found.size() && i < wanted.size() && found[i] == wanted[i]) {
        if (found[i++] == '\n') begin = i;
    }
    const auto line = [begin](const std::string& text) {
        return text.substr(std::min(begin, text.size()), text.find('\n', begin) - begin);
    };
    return fmt::format("`{}`, but the manifest says `{}`", line(found), line(wanted));
}

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

void check_attributes(Examination& examination, const Attributes& attributes,
                      const Attributes& wanted) {
    const std::map<std::string, std::string> found(attributes.begin(), attributes.end());
    for (const auto& [name, text] : wanted) {
        const auto entry = found.find(name);
        if (entry == found.end()) {
            examination.expect(false, "metadata", fmt::format("the attribute {} is missing", name));
            continue;
        }
        examination.expect(entry->second == text, "metadata",
                           fmt::format("{} is {}", name, first_difference(entry->second, text)));
    }
}

void check_catches(Examination& examination, const ReadableTexture& texture, int dimensions,
                   const std::vector<CaughtProbe>& probes,
                   const std::vector<std::string>& catches) {
    std::map<std::string, int> shown;  // at so many probes, in the way that shows at the fewest
    for (const WrongLookup& wrong : wrong_lookups(texture.use, dimensions)) {
        const auto count = static_cast<int>(
            std::count_if(probes.begin(), probes.end(),
                          [&](const CaughtProbe& probe) { return shows(texture, probe, wrong); }));
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

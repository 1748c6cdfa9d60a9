#include "bakers/io/examination.h"

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
    return fmt::format("`{}`, the manifest says `{}`", line(found), line(wanted));
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
        fmt::format("at {} the file gives ({}), the manifest says ({}) ± ({})", place,
                    fmt::join(found, ", "), fmt::join(value, ", "), fmt::join(tolerance, ", ")));
}

}  // namespace skybake

// Places that probes name.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

namespace skybake::test {

// A coordinate of the place of a probe, of a table or of a volume.
template <class AnyProbe>
double at(const AnyProbe& probe, std::string_view name) {
    const auto found = std::find_if(probe.at.begin(), probe.at.end(),
                                    [&](const auto& one) { return one.first == name; });
    if (found == probe.at.end()) {
        ADD_FAILURE() << "no " << name;
        return 0;
    }
    return found->second;
}

}  // namespace skybake::test

// Names of variants' folders: "0007_threshold=0.35_seed=2".
#pragma once

#include <string>
#include <vector>

#include "config/sweep/sweep.h"

namespace skybake {

// What tells each path from the others: its last name, with as many of those before as that takes.
// "clouds.c.threshold" is "threshold", next to "clouds.d.threshold" it is "c.threshold".
std::vector<std::string> distinguishing_names(const std::vector<std::string>& paths);

// The names of the variants of one sweep. Unique by their numbers, of letters, digits and
// `+-.,=_` alone and at most 100 long, so that every file system, shell and URL takes them.
class VariantNames {
  public:
    explicit VariantNames(const config::Sweep& sweep);

    std::string name(int index) const;

  private:
    const config::Sweep& sweep_;
    std::vector<std::string> keys_;
    int digits_ = 4;
};

}  // namespace skybake

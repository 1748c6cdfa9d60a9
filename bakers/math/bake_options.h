// How, not what, to bake: none of it changes a texel.
#pragma once

#include "bakers/math/progress.h"

namespace skybake {

// How thoroughly a table's error is measured.
enum class Certification { off, quick, full };

struct BakeOptions {
    int threads = 0;  // 0: as many as the machine has
    Certification certification = Certification::quick;
    Progress* progress = nullptr;

    // Once true a bake returns early, with a result that is not to be used.
    bool cancelled() const { return progress != nullptr && progress->cancelled(); }
};

}  // namespace skybake

// Which of several choices are worth their price.
#pragma once

#include <vector>

namespace skybake {

struct CostAndError {
    double cost = 0;
    double error = 0;
};

// True for each choice that no other beats: by a smaller error at no greater cost, or by a smaller
// cost at the same error. Costs that are apart by no more than the share `noise` count as the same
// where errors differ. A choice that is not finite is never on the front.
std::vector<bool> pareto_front(const std::vector<CostAndError>& choices, double noise = 0);

}  // namespace skybake

// Which of several choices are worth their price.
#pragma once

#include <vector>

namespace skybake {

struct CostAndError {
    double cost = 0;
    double error = 0;
};

// True for each choice that no other beats: none costs no more and errs no more, and less in one of
// the two. Equal choices share their fate; one that is not finite is never on the front.
std::vector<bool> pareto_front(const std::vector<CostAndError>& choices);

}  // namespace skybake

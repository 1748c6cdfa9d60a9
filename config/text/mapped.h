// Makes a list of what a function, or a member, is of each item of another list.
#pragma once

#include <functional>
#include <iterator>
#include <vector>

namespace skybake {

// Returns a list of `of` of each item of `items`, in order: mapped<std::string>(layers, &Layer::name).
template <class Result, class Items, class Of>
std::vector<Result> mapped(Items&& items, const Of& of) {
    std::vector<Result> results;
    results.reserve(std::size(items));
    for (auto&& item : items) results.push_back(std::invoke(of, item));
    return results;
}

}  // namespace skybake

// Results that are kept for the life of the process.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace skybake {

// Returns the result of the first call with an equal request, which `make` made. `request` is all
// that the result depends on. May be called from any thread. Calls that arrive while the first one
// is still computing compute the result themselves.
template <class Result, class Request>
std::shared_ptr<const Result> remembered(
    Request request, const std::function<std::shared_ptr<const Result>()>& make) {
    using Entry = std::pair<Request, std::shared_ptr<const Result>>;
    static std::mutex mutex;
    static std::vector<Entry> results;
    const auto known = [&]() -> std::shared_ptr<const Result> {
        const auto found = std::ranges::find(results, request, &Entry::first);
        return found == results.end() ? nullptr : found->second;
    };
    {
        const std::lock_guard lock(mutex);
        if (auto result = known()) return result;
    }
    // Not under the lock: a thread that waits inside parallel_for may be given another task of the
    // pool, which may ask for particles too.
    auto made = make();
    const std::lock_guard lock(mutex);
    if (auto earlier = known()) return earlier;
    return results.emplace_back(std::move(request), std::move(made)).second;
}

}  // namespace skybake

#include "bakers/math/startable_threads.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <future>
#include <string>
#include <thread>
#include <vector>

namespace skybake {
namespace {

// A thread that has been joined counts until the system has removed it, some microseconds later.
void wait_until_gone(pid_t thread) {
    const std::string name = fmt::format("/proc/self/task/{}", thread);
    const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    while (::access(name.c_str(), F_OK) == 0 && std::chrono::steady_clock::now() < patience) {
        std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
}

}  // namespace

int startable_threads(int wanted) {
    std::promise<void> all_have_begun;
    const std::shared_future<void> end = all_have_begun.get_future().share();
    std::vector<pid_t> numbers(static_cast<std::size_t>(wanted));
    std::vector<std::thread> threads;
    try {
        threads.reserve(numbers.size());
        for (pid_t& number : numbers) {
            threads.emplace_back([&number, end] {
                number = ::gettid();
                end.wait();
            });
        }
    } catch (const std::exception&) {  // no thread, or no memory for one
    }
    all_have_begun.set_value();
    for (std::size_t i = 0; i < threads.size(); ++i) {
        threads[i].join();
        wait_until_gone(numbers[i]);
    }
    return static_cast<int>(threads.size());
}

}  // namespace skybake

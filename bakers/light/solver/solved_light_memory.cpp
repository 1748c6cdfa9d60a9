#include "bakers/light/solver/solved_light_memory.h"

#include <mutex>

namespace skybake {

namespace {

struct Remembered {
    SkyMedium medium;
    SolverSettings settings;
    std::shared_ptr<const SolvedLight> light;
};

}  // namespace

std::shared_ptr<const SolvedLight> remembered_light(const SkyMedium& medium,
                                                    const SolverSettings& settings, int threads,
                                                    Progress* progress) {
    static std::mutex mutex;
    static Remembered last;
    {
        const std::lock_guard lock(mutex);
        if (last.light && last.settings == settings && last.medium == medium) return last.light;
    }
    // Not under the lock: solving waits for threads, which may ask for light too.
    auto light =
        std::make_shared<const SolvedLight>(solve_light(medium, settings, threads, progress));
    if (progress && progress->cancelled()) return light;
    const std::lock_guard lock(mutex);
    last = {medium, settings, light};
    return light;
}

}  // namespace skybake

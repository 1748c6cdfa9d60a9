// Shared by the tests of sweeps: a recipe that bakes in milliseconds, and folders compared.
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "bakers/workspace/sweep/index_files.h"
#include "bakers/workspace/sweep/run_sweep.h"
#include "config/recipe/recipe.h"
#include "tests/io/files.h"
#include "tests/support/outcomes.h"

namespace skybake::testing {

// A noise that is baked, and a cloud of it.
inline const std::string swept_recipe =
    "[noise.n.channels.Y]\ntype = \"worley\"\nfrequency = 2\noctaves = 1\n"
    "[clouds.c]\nnoise = \"n\"\nextent = [\"6 km\", \"6 km\", \"1 km\"]\n"
    "[bake.n]\nasset = \"noise_volume\"\nnoise = \"n\"\nsize = [8, 8, 8]\n"
    "[bake.c]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [8, 8, 8]\nformats = [\"exr\"]\n";

// Every file below a folder, without the wall times in manifests and the hashes over them, and without
// those of a sweep.
inline std::map<std::string, std::string> files_below(const std::filesystem::path& folder) {
    static const std::regex timing(R"("timing": \{[^}]*\}|"hash": "[^"]*")");
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        std::string bytes = read_bytes(entry.path());
        if (entry.path().filename() == manifest_name) {
            bytes = std::regex_replace(bytes, timing, "");
        }
        if (entry.path().filename() == sweep_timing_name) bytes.clear();
        files[entry.path().lexically_relative(folder).string()] = std::move(bytes);
    }
    return files;
}

inline SweepJob job_of(const std::filesystem::path& recipe, const std::vector<std::string>& vary,
                       const std::filesystem::path& folder) {
    SweepJob job;
    job.recipe = recipe;
    job.folder = folder;
    config::SweepOptions options;
    options.vary = vary;
    job.sweep = test::without_diagnostics(config::load_sweep(recipe, {}, options));
    return job;
}

// Counts, and stops the sweep after so many variants.
class CountingObserver : public SweepObserver {
  public:
    explicit CountingObserver(int most = 1 << 30) : most_(most) {}

    bool cancelled() const override { return made >= most_; }
    void advance(const VariantResult&, std::string_view, double) override {}
    void waits(const VariantResult&) override {}
    void finished(const VariantResult& variant, bool is_made, double) override {
        ++finished_count;
        if (is_made && variant.status == VariantStatus::done) ++made;
    }

    std::atomic<int> made{0};
    int finished_count = 0;

  private:
    int most_;
};

inline std::vector<VariantResult> run(const SweepJob& job, SweepObserver& observer) {
    return run_sweep(job, plan_sweep(job, [] { return false; }), observer);
}

inline std::vector<VariantResult> run(const SweepJob& job) {
    CountingObserver observer;
    return run(job, observer);
}

}  // namespace skybake::testing

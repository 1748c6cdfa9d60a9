// Shared by the tests of incremental baking: small recipes, and an observer that remembers.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "bakers/workspace/bake_folder.h"
#include "tests/io/files.h"
#include "tests/support/outcomes.h"

namespace skybake::testing {

inline config::Recipe recipe_of(const std::string& text, const std::filesystem::path& folder = {},
                                const std::vector<std::string>& settings = {}) {
    return test::without_errors(config::parse_recipe(text, "recipe.toml", folder, settings));
}

// Two tables that bake in milliseconds, and a noise.
inline const std::string small_recipe = R"(
preset = "earth_hillaire"
[bake.transmittance]
size = [32, 8]
[bake.multiple_scattering]
method = "converged"
mapping = "hillaire"
size = [8, 8]
max_texel_error = "20 %"
[noise.shape.channels.Y]
type = "worley"
frequency = 4
[bake.shape]
asset = "noise_volume"
noise = "shape"
size = [16, 16, 16]
formats = ["exr", "bin"]
)";

class RememberingObserver : public BakeObserver {
  public:
    class Silent : public Progress {
      public:
        explicit Silent(const RememberingObserver& observer) : observer_(observer) {}
        void advance(std::string_view, double) override {}
        bool cancelled() const override { return observer_.cancelled(); }

      private:
        const RememberingObserver& observer_;
    };

    bool cancelled() const override { return cancel; }
    void waits() override { ++waited; }
    void planned(const FolderPlan& plan) override {
        for (const PlannedAsset& asset : plan.assets) reasons.push_back(asset.reasons);
    }
    std::unique_ptr<Progress> begin(std::string_view asset) override {
        if (asset == cancel_at) cancel = true;
        begun.emplace_back(asset);
        return std::make_unique<Silent>(*this);
    }

    bool cancel = false;
    std::string cancel_at;
    int waited = 0;
    std::vector<std::vector<std::string>> reasons;
    std::vector<std::string> begun;
};

// A bake of a whole recipe, with what it needs to live as long.
struct TestBake {
    explicit TestBake(config::Recipe recipe_, std::filesystem::path folder)
        : recipe(std::move(recipe_)) {
        bake.recipe = &recipe;
        bake.bakes = recipe.parameters.bakes;
        bake.folder = std::move(folder);
        bake.threads = 1;
    }
    TestBake(const TestBake&) = delete;
    TestBake& operator=(const TestBake&) = delete;

    config::Outcome<BakedFolder> run() {
        observer = RememberingObserver();
        return bake_folder(bake, observer);
    }
    // The states of all assets; empty where the bake failed.
    std::vector<AssetState> states() {
        const auto baked = run();
        std::vector<AssetState> result;
        if (!baked.value) return result;
        for (const FinishedAsset& asset : baked.value->assets) result.push_back(asset.state);
        return result;
    }

    config::Recipe recipe;
    FolderBake bake;
    RememberingObserver observer;
};

}  // namespace skybake::testing

// The bakers and nothing else, for a compiler whose bytes are to be compared: building the command
// line, sweeps and previews as well would take twice as long.
//   bake_without_cli bake RECIPE -o FOLDER [--certify=off] ...
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>

#include "bakers/workspace/bake_folder.h"

namespace {

class Silent : public skybake::Progress {
  public:
    void advance(std::string_view, double) override {}
    bool cancelled() const override { return false; }
};

class Unwatched : public skybake::BakeObserver {
  public:
    bool cancelled() const override { return false; }
    void waits() override {}
    void planned(const skybake::FolderPlan&) override {}
    std::unique_ptr<skybake::Progress> begin(std::string_view) override {
        return std::make_unique<Silent>();
    }
};

int report(const std::vector<skybake::config::Diagnostic>& diagnostics) {
    for (const auto& diagnostic : diagnostics) {
        std::fprintf(stderr, "%s: %s\n", diagnostic.code.c_str(), diagnostic.message.c_str());
    }
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 5 || std::strcmp(argv[1], "bake") != 0 || std::strcmp(argv[3], "-o") != 0) return 2;
    const auto recipe = skybake::config::load_recipe(argv[2]);
    if (!recipe.value) return report(recipe.diagnostics);
    skybake::FolderBake bake;
    bake.recipe = &*recipe.value;
    bake.bakes = recipe.value->parameters.bakes;
    bake.folder = argv[4];
    for (int i = 5; i < argc; ++i) {
        if (std::strcmp(argv[i], "--certify=off") == 0) {
            bake.certification = skybake::Certification::off;
        }
    }
    Unwatched observer;
    const auto baked = skybake::bake_folder(bake, observer);
    return baked.value ? 0 : report(baked.diagnostics);
}

// Tells people, or with --json machines, how a bake of a folder goes.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/workspace/bake_folder.h"

namespace skybake::cli {

class Console;

class BakeReporter : public BakeObserver {
  public:
    BakeReporter(Console& console, bool json) : console_(console), json_(json) {}

    bool cancelled() const override;
    void waits() override;
    void planned(const FolderPlan& plan) override;
    std::unique_ptr<Progress> begin(std::string_view asset) override;

  private:
    Console& console_;
    bool json_;
    std::vector<std::string> stale_;  // what is to be made, in order
};

}  // namespace skybake::cli

// What the plan of memory says of itself.
#include "memory_plan.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace shodo {
namespace {

TEST(MemoryPlan, EveryStageAndPartHasANameOfItsOwn) {
  std::set<std::string> stages, parts;
  for (std::size_t k = 0; k < kPlanStages; ++k) stages.insert(plan_stage_name(static_cast<PlanStage>(k)));
  EXPECT_EQ(stages.size(), kPlanStages);
  EXPECT_EQ(stages.count(""), 0u);
  constexpr std::size_t kParts = static_cast<std::size_t>(PlanPart::kDrawing) + 1;
  for (std::size_t k = 0; k < kParts; ++k) {
    const PartText text = plan_part_text(static_cast<PlanPart>(k));
    parts.insert(text.name);
    EXPECT_NE(std::string(text.formula), "") << text.name;
  }
  EXPECT_EQ(parts.size(), kParts);
}

}  // namespace
}  // namespace shodo

#include "io/clips/bids_files.h"

#include <gmock/gmock.h>

#include "tests/io/clips/clip_folder.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class BidsFilesTest : public ClipFolder {};

TEST_F(BidsFilesTest, OfHigherFoldersApplyIfTheirEntitiesAreInTheName) {
  const std::string motion = Write("set/sub-1/motion/sub-1_task-walk_tracksys-a_motion.tsv", "");
  EXPECT_THAT(FindBidsFiles(motion, "motion.json"), IsEmpty());
  const std::string beside = Write("set/sub-1/motion/sub-1_task-walk_tracksys-a_motion.json", "");
  Write("set/sub-1/sub-1_task-walk_motion.json", "");
  Write("set/sub-1/sub-1_motion.json", "");           // the file with more entities is nearer
  Write("set/sub-1/sub-1_task-run_motion.json", "");  // another task
  Write("set/motion.json", "");
  Write("set/emotion.json", "");
  Write("set/dataset_description.json", "");
  Write("task-walk_motion.json", "");  // above the data set
  EXPECT_THAT(
      FindBidsFiles(motion, "motion.json"),
      ElementsAre(::testing::EndsWith("set/motion.json"), ::testing::EndsWith("sub-1_task-walk_motion.json"), beside));
}

}  // namespace
}  // namespace etude

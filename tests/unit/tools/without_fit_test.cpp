// A tool that was built with -DRUNG_CAM_FIT=OFF: `rung cam fit` says what is missing, reads and writes nothing, and the
// other subcommands work. cam_fit.cpp is compiled into this test as such a build compiles it.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tools/driver/cam.h"
#include "tools/driver/commands.h"

#ifdef RUNG_CAM_FIT
#error "this test is the tool without fits"
#endif

namespace rung::driver {
namespace {

class Record : public Sink {
 public:
  void message(std::string_view text) override { said += text; }
  std::string output(std::string_view text) override { return printed += text, std::string(); }
  void error(std::string_view what) override { said += what; }
  std::string said, printed;
};

TEST(WithoutFit, SaysWhatIsMissing) {
  Record sink;
  CamOptions options;
  ASSERT_EQ("", setCamOption("--tolerance", "0.1", options));
  EXPECT_EQ(kUsage, runCam({"fit", "points.csv"}, options, "without_fit.cam", sink));
  EXPECT_NE(std::string::npos, sink.said.find("built without `rung cam fit`")) << sink.said;
  EXPECT_NE(std::string::npos, sink.said.find("libceres-dev")) << sink.said;
  EXPECT_NE(std::string::npos, sink.said.find("-DRUNG_CAM_FIT=ON")) << sink.said;
  EXPECT_EQ("", sink.printed);
  EXPECT_FALSE(std::filesystem::exists("without_fit.cam"));
}

TEST(WithoutFit, HasTheOtherSubcommands) {
  Record sink;
  EXPECT_EQ(kSuccess, runCam({"law", "cycloid"}, {}, "", sink));
  EXPECT_NE(std::string::npos, sink.printed.find("x,y,v,a,j")) << sink.printed;
  EXPECT_EQ("", sink.said);
}

}  // namespace
}  // namespace rung::driver

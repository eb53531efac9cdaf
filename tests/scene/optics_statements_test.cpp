// Materials that do more than reflect diffusely, and the background, as a scene file has them.
#include <gtest/gtest.h>

#include <string>

#include "support/scene_from_text.h"

namespace shodo {
namespace {

const std::string kEnd = "object o\ntri m 0 0 0 0 0 1 1 0 0\n";

TEST(OpticsStatements, OnlyMaterialsThatDoMoreHaveOptics) {
  const LoadedScene s("shodo 1\nmaterial m diffuse 0.5\nmaterial chrome diffuse 0.1 reflect 0.7\n"
                      "material dull diffuse 0.1 reflect 0 transmit 0 highlight 0 10\n"
                      "material pane transmit 0.8 0.1 0.2 diffuse 0.02 highlight 0.1 200\n" + kEnd);
  ASSERT_EQ(s.scene.optics.size(), 2u);
  const Optics& chrome = s.scene.optics[0];
  EXPECT_EQ(chrome.material, 1u);
  EXPECT_EQ(chrome.reflect, (Rgb{{0.7, 0.7, 0.7}}));
  EXPECT_FALSE(chrome.transmits());
  const Optics& pane = s.scene.optics[1];
  EXPECT_EQ(pane.material, 3u);
  EXPECT_EQ(pane.transmit, (Rgb{{0.8, 0.1, 0.2}}));
  EXPECT_EQ(pane.highlight, 0.1);
  EXPECT_EQ(pane.highlight_exponent, 200);
  EXPECT_EQ(s.scene.channels, 3u);
  EXPECT_EQ(s.scene.optics_of(0), nullptr);
  EXPECT_EQ(s.scene.optics_of(3), &pane);
}

TEST(OpticsStatements, GreyOnesLeaveASceneGrey) {
  const LoadedScene s("shodo 1\nbackground zenith 1 horizon 2 ground 3\n"
                      "material m diffuse 0.1 transmit 0.5 reflect 0.2\n" + kEnd);
  EXPECT_EQ(s.scene.channels, 1u);
  ASSERT_EQ(s.scene.background.size(), 1u);
  EXPECT_EQ(s.scene.background[0].up, (Vec3{0, 1, 0}));
  const LoadedScene coloured("shodo 1\nbackground zenith 1 horizon 2 2 1 ground 3\nmaterial m diffuse 0.1\n" + kEnd);
  EXPECT_EQ(coloured.scene.channels, 3u);
}

TEST(OpticsStatements, AHighlightGetsWhatTheOthersLeave) {
  const LoadedScene s("shodo 1\nmaterial m diffuse 0.5 0.6 0.1 reflect 0.2 highlight 0.9 10\n" + kEnd);
  EXPECT_NEAR(s.scene.optics[0].highlight, 0.9999 - 0.8, 1e-15);
}

TEST(OpticsStatements, WhatSendsOutMoreThanItGetsIsRefused) {
  const LoadedScene just("shodo 1\nmaterial m diffuse 0.1 reflect 0.8 transmit 0.0999\n" + kEnd);
  const TestScene s("shodo 1\nmaterial m diffuse 0.1 0.1 0.1 reflect 0.5 transmit 0.1 0.4 0.1\n" + kEnd);
  EXPECT_EQ(s.status.code, StatusCode::kScene);
  EXPECT_EQ(s.status.line, 2u);
  EXPECT_EQ(s.status.column, 10u);
  const std::string message = s.status.message;
  EXPECT_NE(message.find("at most 0.9999 (green), found 1"), std::string::npos) << message;
}

TEST(OpticsStatements, MistakesAreNamed) {
  const auto expect_refused = [](const std::string& line, const std::string& message) {
    const TestScene s("shodo 1\n" + line + "\nmaterial m diffuse 0.1\n" + kEnd);
    EXPECT_EQ(s.status.code, StatusCode::kScene) << line;
    EXPECT_NE(std::string(s.status.message).find(message), std::string::npos) << line << "\n" << s.status.message;
  };
  expect_refused("material n diffuse 0.1 reflect 1", "from 0 to 0.9999 (reflect)");
  expect_refused("material n diffuse 0.1 transmit", "expected a number");
  expect_refused("material n diffuse 0.1 highlight 0.5", "expected a number (exponent of the highlight)");
  expect_refused("material n diffuse 0.1 highlight 0.5 0.5", "from 1 to");
  expect_refused("material n reflect 0.5", "expected diffuse");
  expect_refused("background zenith 1 horizon 2", "expected ground");
  expect_refused("background zenith 1 horizon 2 ground -1", "(ground)");
  expect_refused("background zenith 1 horizon 2 ground 1\nbackground zenith 1 horizon 2 ground 1", "once only");
}

}  // namespace
}  // namespace shodo

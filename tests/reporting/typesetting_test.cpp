#include "courant/reporting/typesetting.hpp"

#include <boost/test/unit_test.hpp>
#include <string>

using namespace courant;

BOOST_AUTO_TEST_SUITE(typesetting)

BOOST_AUTO_TEST_CASE(manifolds_are_written_as_one_writes_them) {
  const auto set = [](const char* text) { return typeset_manifolds(text).str(); };
  BOOST_TEST(set("CotangentBundle(SpecialOrthogonal3(exponential))") == "<i>T</i>*SO(3)");
  BOOST_TEST(set("system on Sphere(2, cayley) — one run") ==
             "system on <i>S</i><sup>2</sup> — one run");
  BOOST_TEST(set("Product(Euclidean(1), Euclidean(12))") == "ℝ × ℝ<sup>12</sup>");
  BOOST_TEST(set("TangentBundle(Product(Torus(2), SpecialEuclidean3(exponential)))") ==
             "<i>T</i>(<i>T</i><sup>2</sup> × SE(3))");
  BOOST_TEST(set("SpecialOrthogonal(4)") == "SO(4)");
}

BOOST_AUTO_TEST_CASE(manifolds_as_plain_text) {
  BOOST_TEST(manifolds_in_unicode("system on CotangentBundle(Sphere(2, exponential))") ==
             "system on T*S²");
  BOOST_TEST(manifolds_in_unicode("Product(Euclidean(12), MySphere(2)) & <b> 'c'") ==
             "ℝ¹² × MySphere(2) & <b> 'c'");
}

BOOST_AUTO_TEST_CASE(anything_else_stays_as_it_is) {
  for (const char* text : {"", "4 point vortices", "Stiefel(4, 2)", "Sphere", "Sphere(2",
                           "Sphere(2, (a)", "MySphere(2)", "()", "f(x) – ℝ"})
    BOOST_TEST(typeset_manifolds(text).str() == text);
  BOOST_TEST(typeset_manifolds("Sphere(<b>)").str() == "<i>S</i><sup>&lt;b&gt;</sup>");
}

BOOST_AUTO_TEST_CASE(depth_has_an_end) {
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "TangentBundle(";
  deep += std::string(100'000, ')');
  BOOST_TEST(typeset_manifolds(deep).str().starts_with("TangentBundle("));
}

BOOST_AUTO_TEST_CASE(sentences_have_subscripts_and_italics) {
  BOOST_TEST(typeset("a space S_{k+1} of TM").str() ==
             "a space <i>S</i><sub><i>k</i>+1</sub> of <i>TM</i>");
}

BOOST_AUTO_TEST_CASE(numbers_stay_in_one_line) {
  BOOST_TEST(unbroken("a slope of 2 × 10⁻¹¹ ± 4 × 10⁻¹², 3 × 4") ==
             "a slope of 2\u00a0×\u00a010⁻¹¹\u00a0±\u00a04\u00a0×\u00a010⁻¹², 3 × 4");
}

BOOST_AUTO_TEST_SUITE_END()

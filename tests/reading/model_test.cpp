#include "courant/reading/model.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/manifolds/euclidean.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(model)

namespace {

class Named final : public ImplicitSystem {
 public:
  explicit Named(std::vector<std::string> coordinates)
      : ImplicitSystem(std::make_shared<Euclidean>(static_cast<Index>(coordinates.size())), 1, 1,
                       {.coordinates = coordinates, .auxiliary = {"lambda"}}) {}

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector&, const ExprVector&,
                         const Expr&) const override {
    return x.head(1);
  }
};

std::vector<std::string> declared(std::vector<std::string> coordinates) {
  const Model model = model_of(std::make_shared<Named>(std::move(coordinates)));
  std::vector<std::string> names;
  for (const Declaration& declaration : model.vocabulary.coordinates.declarations())
    names.push_back(declaration.name + ":" + std::to_string(declaration.size()));
  return names;
}

using Names = std::vector<std::string>;

}  // namespace

BOOST_AUTO_TEST_CASE(elements_side_by_side_are_an_array) {
  BOOST_TEST(declared({"x", "r[0]", "r[1]", "r[2]", "y"}) == (Names{"x:1", "r:3", "y:1"}));
  BOOST_TEST(declared({"R[0][0]", "R[0][1]", "R[1][0]", "R[1][1]"}) == (Names{"R:4"}));
}

// Formulas cannot have them; the others stay in their places.
BOOST_AUTO_TEST_CASE(what_is_no_name_has_none_in_formulas) {
  const Model model = model_of(std::make_shared<Named>(Names{"a b", "r[1]", "z"}));
  BOOST_TEST(model.vocabulary.coordinates.size() == 3);
  BOOST_TEST(model.vocabulary.coordinates.find(parse_reference("z")).first == 2);
  BOOST_TEST(!model.vocabulary.coordinates.contains("r"));
  BOOST_TEST(model.vocabulary.unknowns.contains("lambda"));
  BOOST_TEST(model.description == "system on Euclidean(3)");
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant

#include "courant/reporting/formula_typesetting.hpp"

#include <boost/test/unit_test.hpp>
#include <string>

BOOST_AUTO_TEST_SUITE(formula_typesetting_test)

using namespace courant;

BOOST_AUTO_TEST_CASE(latex_of_formulas) {
  BOOST_TEST(latex_math("p_x^2/(2*m)") == "\\frac{{p_{x}}^{2}}{2\\,m}");
  BOOST_TEST(latex_math("q[0]' = sqrt(a[1][2])") == "\\dot{q}_{0} = \\sqrt{a_{1, 2}}");
  BOOST_TEST(latex_math("k*cos(theta_1)") == "k \\cos \\theta_{1}");
  BOOST_TEST(latex_math("sin(x + y)^2") == "{\\left( \\sin\\left( x + y\\right)\\right)}^{2}");
  BOOST_TEST(latex_math("x''") == "\\ddot{x}");
  BOOST_TEST(latex_math("theta1'") == "\\dot{\\theta}_{1}");
  BOOST_TEST(latex_math("sum(i, 0, n-1, x[i]^2)") == "\\sum_{i=0}^{n - 1} {x_{i}}^{2}");
  BOOST_TEST(latex_math("tension*x") == "\\mathrm{tension}\\,x");
  BOOST_TEST(latex_math("1.5e-3*x") == "1.5 \\cdot {10}^{-3}\\,x");
  BOOST_TEST(latex_math("x*sin(a)*(y - 1)") == "x \\sin a \\cdot \\left( y - 1\\right)");
  BOOST_TEST(latex_math("sin(a)*cos(f)*v") == "\\sin a \\cos f \\cdot v");
  BOOST_TEST(latex_math("sin(a + f)*v") == "\\sin\\left( a + f\\right)\\,v");
  BOOST_TEST(latex_math("sin(a)*2*f") == "\\sin a \\cdot 2\\,f");
  BOOST_TEST(latex_math("-2*phi/9") == "-\\frac{2\\,\\phi}{9}");
  BOOST_TEST(latex_math("-(a + b)/c") == "-\\frac{a + b}{c}");
  BOOST_TEST(latex_math("(-a + b)/c") == "\\frac{-a + b}{c}");
  BOOST_TEST(latex_math("δp_x = ε*y") == "\\delta p_{x} = \\varepsilon\\,y");
  BOOST_TEST(latex_math("if(x < 0, -x, x)") ==
             "\\begin{cases}-x & \\text{if } x < 0 \\\\ x & \\text{otherwise}\\end{cases}");
}

// 1e-06 is a power of ten, not what a computer writes.
BOOST_AUTO_TEST_CASE(powers_of_ten) {
  BOOST_TEST(latex_math("1e-06") == "{10}^{-6}");
  BOOST_TEST(latex_math("2.5E+07*k") == "2.5 \\cdot {10}^{7}\\,k");
  BOOST_TEST(latex_math("k*1e3") == "k \\cdot {10}^{3}");
  BOOST_TEST(latex_math("(2e-3)^2") == "{\\left( 2 \\cdot {10}^{-3}\\right)}^{2}");
  BOOST_TEST(latex_math("1e-00") == "{10}^{-0}");
  const std::string number = math("C = 2.5e-06").str();
  BOOST_TEST(
      number.find(
          "<mn>2.5</mn><mo>·</mo><msup><mrow><mn>10</mn></mrow><mrow><mo>−</mo><mn>6</mn>") !=
          std::string::npos,
      number);
}

// Arrays of JSON, as parameters have them.
BOOST_AUTO_TEST_CASE(arrays) {
  BOOST_TEST(latex_math("l = [0.2,\"a/2\"]") == "l = \\left( 0.2, \\frac{a}{2}\\right)");
  BOOST_TEST(latex_math("M = [[1,0],[\"m\",2]]") ==
             "M = \\begin{pmatrix} 1 & 0 \\\\ m & 2 \\\\ \\end{pmatrix}");
  for (const char* text : {"l = []", "l = [1, {}]", "M = [[1],[2,3]]", "M = [[1],2]", "l = [1"})
    BOOST_TEST(latex_math(text).starts_with("\\text{"), text);
}

// A long formula ends its lines before + and -, and says what the short one says.
BOOST_AUTO_TEST_CASE(long_formulas_have_lines) {
  const std::string term = "a_1*b_2*c_3*d_4*e_5",
                    formula = "x' = " + term + " - " + term + " + " + term + " - " + term;
  BOOST_TEST(!is_long_formula("x' = " + term));
  BOOST_TEST(latex_displayed("x' = " + term) == latex_math("x' = " + term));
  BOOST_TEST(is_long_formula(formula + " - " + formula.substr(5)));
  const std::string lines = latex_displayed(formula + " - " + formula.substr(5));
  BOOST_TEST(lines.starts_with("\\begin{aligned}\n& \\dot{x} = a_{1}"), lines);
  BOOST_TEST(lines.find("\\\\\n& \\quad {} ") != std::string::npos, lines);
  BOOST_TEST(lines.find("\\dot{x}", 30) == std::string::npos, lines);
  const auto count = [](std::string_view text, std::string_view part) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string_view::npos; ++at) ++found;
    return found;
  };
  BOOST_TEST(count(lines, "e_{5}") == 8u, lines);
  const std::string pieces = displayed_math(formula + " - " + formula.substr(5)).str();
  BOOST_TEST(count(pieces, "<math ") == 8u, pieces);
  BOOST_TEST(count(pieces, "<mo form=\"infix\">−</mo>") == 5u, pieces);
  BOOST_TEST(count(displayed_math("x' = " + term).str(), "<math ") == 1u);
  // A sum over something too.
  const std::string over =
      latex_displayed("H = (" + formula.substr(5) + " - " + term + " + " + term + ")/(4*pi)");
  BOOST_TEST(count(over, "\\frac{") == 6u, over);
  BOOST_TEST(count(over, "{} - \\frac{") == 3u, over);
  BOOST_TEST(count(over, "}{4\\,\\pi}") == 6u, over);
  // And in a product, over something: lines end in the parentheses.
  const std::string product =
      latex_displayed("p' = -k*(" + formula.substr(5) + " - " + term + " + " + term + ")/(4*pi)");
  BOOST_TEST(product.find("& \\dot{p} = -\\frac{k}{4\\,\\pi}\\,\\bigl( ") != std::string::npos,
             product);
  BOOST_TEST(count(product, "\\\\\n& \\quad {} ") >= 1u, product);
  BOOST_TEST(count(product, "\\bigr)") == 1u, product);
  BOOST_TEST(count(product, "e_{5}") == 6u, product);
  BOOST_TEST(latex_displayed("no formula & text") == latex_math("no formula & text"));
}

// Parentheses stand where leaving them out would change the meaning, and nowhere else.
BOOST_AUTO_TEST_CASE(parentheses) {
  BOOST_TEST(latex_math("a - (b - c)") == "a - \\left( b - c\\right)");
  BOOST_TEST(latex_math("(a - b) - c") == "a - b - c");
  BOOST_TEST(latex_math("a + (b - c)") == "a + b - c");
  BOOST_TEST(latex_math("(a + b)*c") == "\\left( a + b\\right)\\,c");
  BOOST_TEST(latex_math("a*(b*c)") == "a\\,b\\,c");
  BOOST_TEST(latex_math("a*-b") == "a\\,\\left( -b\\right)");
  BOOST_TEST(latex_math("-(a + b)") == "-\\left( a + b\\right)");
  BOOST_TEST(latex_math("(a + b)/c") == "\\frac{a + b}{c}");
  BOOST_TEST(latex_math("(a/b)^2") == "{\\left( \\frac{a}{b}\\right)}^{2}");
  BOOST_TEST(latex_math("(a^b)^c") == "{\\left( {a}^{b}\\right)}^{c}");
  BOOST_TEST(latex_math("-z*p - x") == "-z\\,p - x");
  BOOST_TEST(latex_math("x + (-z)*p") == "x + \\left( -z\\,p\\right)");
  BOOST_TEST(latex_math("-(-x)") == "-\\left( -x\\right)");
  BOOST_TEST(latex_math("2*3") == "2 \\cdot 3");
  BOOST_TEST(
      latex_math("(x - u)*(x^2 + u) - (x - u)*(u^2 + x)") ==
      "\\left( x - u\\right)\\,\\left( {x}^{2} + u\\right) - \\left( x - u\\right)\\,\\left( "
      "{u}^{2} + x\\right)");
}

BOOST_AUTO_TEST_CASE(what_is_no_formula_stays_text) {
  BOOST_TEST(latex_math("equation of x_1 & y") == "\\text{equation of x\\_1 \\& y}");
  BOOST_TEST(math("50% of <b>").str() ==
             "<math><mrow><mtext>50% of &lt;b&gt;</mtext></mrow></math>");
}

BOOST_AUTO_TEST_CASE(mathml_of_formulas) {
  BOOST_TEST(
      math("x^2").str() ==
      "<math><mrow><msup><mrow><mi>x</mi></mrow><mrow><mn>2</mn></mrow></msup></mrow></math>");
  BOOST_TEST(displayed_math("lambda").str() ==
             "<math displaystyle=\"true\"><mrow><mi>λ</mi></mrow></math>");
  BOOST_TEST(math("l*cos(a)").str().find("<mspace width=\"0.17em\"/><mi>cos</mi>") !=
             std::string::npos);
  BOOST_TEST(math("x' = v").str() ==
             "<math><mrow><mover "
             "accent=\"true\"><mrow><mi>x</mi></mrow><mo>˙</mo></mover><mo>=</mo><mi>v</mi></"
             "mrow></math>");
}

BOOST_AUTO_TEST_SUITE_END()

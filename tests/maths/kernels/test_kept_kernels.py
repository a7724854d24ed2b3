"""What is kept of a kernel runs it, and no more."""

from llvmlite import binding

from equipoise.maths.kernels.kept_kernels import names_alone

CODE = """
@"of $a\\22 program" = global i64 7
declare double @elsewhere(double)
define double @here(double %x) {
  %y = call double @elsewhere(double %x)
  ret double %y
}
"""


def test_names_stay_that_are_defined_and_no_code():
    module = binding.parse_bitcode(names_alone(binding.parse_assembly(CODE).as_bitcode()))
    assert {each.name for each in module.functions} == {'of $a" program', "here"}
    assert "elsewhere" not in str(module)
    assert "double" not in str(module)

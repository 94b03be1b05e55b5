"""Expressions of SymPy as formulas of linkproof."""

import functools
from typing import Any

from linkproof.errors import InputError, UnsupportedError

#: Functions of SymPy by the name of their class, and their names in formulas.
FUNCTIONS = {
    "sin": "sin",
    "cos": "cos",
    "tan": "tan",
    "asin": "asin",
    "acos": "acos",
    "atan": "atan",
    "atan2": "atan2",
    "Abs": "abs",
    "exp": "exp",
    "log": "ln",
    "sign": "sign",
}


def _refused(kind: type[InputError] | type[UnsupportedError], message: str, help: str) -> Exception:
    return kind(f"`expression`: {message}\n  = help: {help}", message=message, key="expression", help=help)


@functools.cache
def _printer() -> Any:
    from sympy import Add, E, Float, Mul, Pow, Rational, Symbol, pi
    from sympy.core.function import AppliedUndef
    from sympy.printing.str import StrPrinter

    class FormulaPrinter(StrPrinter):  # type: ignore[misc]
        """Writes an expression with the operators, functions and names of formulas."""

        def _print(self, expression: Any, **settings: Any) -> str:
            # Each kind is checked here, because the base class would also print infinity or the imaginary unit,
            # which formulas do not have.
            if isinstance(expression, Symbol):
                return self._name(expression.name)
            if isinstance(expression, AppliedUndef):
                # A coordinate as a function of time, such as phi(t).
                return self._name(expression.func.__name__)
            if isinstance(expression, Float) and expression.is_finite:
                return repr(float(expression))
            if isinstance(expression, Pow) and expression.base is not E or isinstance(expression, (Add, Mul, Rational)):
                return str(super()._print(expression, **settings)).replace("**", "^")
            if expression is pi:
                return "pi"
            if expression is E:
                return "exp(1)"
            if isinstance(expression, Pow):
                return f"exp({self._print(expression.exp)})"
            kind = type(expression).__name__
            if kind in FUNCTIONS:
                return f"{FUNCTIONS[kind]}({', '.join(self._print(part) for part in expression.args)})"
            help = f"rewrite the expression with sqrt, {', '.join(FUNCTIONS.values())}"
            raise _refused(UnsupportedError, f"a formula has no {kind} of SymPy", help)

        def _name(self, name: str) -> str:
            if not name.isascii() or not name.replace("_", "a").isalnum() or not name[0].isalpha():
                message = f'the symbol "{name}" of SymPy cannot be a name in a formula'
                raise _refused(InputError, message, "use letters, digits and _")
            return name

    return FormulaPrinter()


def _rewritten(expression: Any) -> Any:
    """The expression, in which functions that formulas do not have are expressed by others."""
    from sympy import cos, cosh, cot, coth, csc, exp, sec, sin, sinh, tanh

    expression = expression.replace(sec, lambda x: 1 / cos(x))
    expression = expression.replace(csc, lambda x: 1 / sin(x)).replace(cot, lambda x: cos(x) / sin(x))
    for hyperbolic in (sinh, cosh, tanh, coth):
        expression = expression.replace(hyperbolic, lambda x, of=hyperbolic: of(x).rewrite(exp))
    return expression


def formula(expression: Any) -> str:
    """The text of a formula that equals an expression of SymPy.

    A number of Python is accepted too.
    """
    if isinstance(expression, (int, float)) and not isinstance(expression, bool):
        return repr(expression)
    try:
        from sympy import Expr

        is_expression = isinstance(expression, Expr)
    except ImportError:
        is_expression = False
    if not is_expression:
        message = f"found an object of the class `{type(expression).__name__}` instead of a formula"
        raise _refused(InputError, message, 'give a text such as "r*cos(phi)", or an expression of SymPy')
    return str(_printer().doprint(_rewritten(expression.doit())))

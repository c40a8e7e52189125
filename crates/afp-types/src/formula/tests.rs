//! Constant formulas, and formulas that fail before the plan runs.

use super::*;

/// Entries without known values.
struct Unknowns;

impl Source<()> for Unknowns {
    const FOLDS: bool = true;

    fn entry<V>(&self, _: EntryId, _: impl FnOnce(&Value) -> Option<V>) -> Result<V, Error> {
        Err(Error::Unknown)
    }

    fn convert(&self, (): &(), value: Value) -> Result<Value, Error> {
        Ok(value)
    }
}

/// An operand of this type; `None` is an entry.
fn leaf(value: Option<f64>, shape: Shape) -> Node<()> {
    let op = match (value, shape) {
        (None, _) => Op::Entry(EntryId(0)),
        (Some(value), Shape::Int) => Op::Int(value as i64),
        (Some(value), _) => Op::Float(value),
    };
    Node { op, shape, len: 1, note: () }
}

fn value<const N: usize>(
    op: Op<()>,
    operands: [Option<f64>; N],
    shape: Shape,
) -> Result<Value, Error> {
    let below = operands.map(|operand| leaf(operand, shape));
    let root = Node { op, shape, len: N as u16 + 1, note: () };
    Part { root: &root, below: &below }.value(&Unknowns)
}

#[test]
fn a_constant_zero_divides_no_number() {
    for operator in [Operator::Div, Operator::Rem] {
        for zero in [0.0, -0.0] {
            let left = [None, Some(1.0)];
            for left in left {
                let float = value(Op::Binary(operator), [left, Some(zero)], Shape::Float);
                assert_eq!(float, Err(Error::DivisionByZero));
            }
        }
        let int = value(Op::Binary(operator), [None, Some(0.0)], Shape::Int);
        assert_eq!(int, Err(Error::DivisionByZero));
    }
    let int = |operator, a, b| value(Op::Binary(operator), [a, Some(b)], Shape::Int);
    assert_eq!(int(Operator::Mul, None, 0.0), Err(Error::Unknown));
    assert_eq!(int(Operator::Rem, Some(-7.0), 3.0), Ok(Value::Int(-1)));
    assert_eq!(int(Operator::Add, Some(i64::MAX as f64), 1.0), Err(Error::Overflow));
}

#[test]
fn bounds_in_the_wrong_order_fail_for_any_value() {
    let clamp = |operands| value(Op::Call(Function::Clamp), operands, Shape::Int);
    assert_eq!(clamp([None, Some(2.0), Some(1.0)]), Err(Error::NoRange));
    assert_eq!(clamp([None, Some(1.0), Some(2.0)]), Err(Error::Unknown));
    assert_eq!(clamp([None, None, Some(2.0)]), Err(Error::Unknown));
    assert_eq!(clamp([Some(7.0), Some(1.0), Some(2.0)]), Ok(Value::Int(2)));
}

#[test]
fn operands_are_found_in_the_array() {
    // (1 - 2) - (3 - -4)
    let leaf = |value| leaf(Some(value), Shape::Float);
    let node = |op, len| Node { op, shape: Shape::Float, len, note: () };
    let below = [
        leaf(1.0),
        leaf(2.0),
        node(Op::Binary(Operator::Sub), 3),
        leaf(3.0),
        leaf(4.0),
        node(Op::Neg, 2),
        node(Op::Binary(Operator::Sub), 4),
    ];
    let root = node(Op::Binary(Operator::Sub), 8);
    let whole = Part { root: &root, below: &below };
    assert_eq!(whole.float(&Unknowns), Ok(-8.0));
    assert_eq!(
        whole.operands().map(|part| part.below.len()).collect::<heapless::Vec<_, 3>>(),
        [2, 3]
    );
}

//! A fingerprint as people read it.

use std::fmt;

use super::{Arithmetic, Fingerprint};

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let survive = |wrong: usize| match wrong {
            0 => "survives".to_owned(),
            n => format!("is lost in {n}"),
        };
        let rounded = |wrong: usize, ulp: u32| match wrong {
            0 => "correctly rounded".to_owned(),
            n => format!("{n} not nearest, up to {ulp} ULP"),
        };
        writeln!(f, "{}, {} pairs:", self.route, self.pairs)?;
        writeln!(f, "  x + y               {}", rounded(self.sum_wrong, 1))?;
        writeln!(f, "  x * y               {}", rounded(self.product_wrong, 1))?;
        writeln!(f, "  x / y               {}", rounded(self.quotient_wrong, self.quotient_ulp))?;
        writeln!(f, "  sqrt x              {}", rounded(self.root_wrong, self.root_ulp))?;
        writeln!(f, "  error of x + y      {}", survive(self.sum_error_wrong))?;
        writeln!(f, "  error of x * y      {}", survive(self.product_error_wrong))?;
        match self.contracted {
            0 => writeln!(f, "  x*y - c*(y*x)       as written")?,
            n => writeln!(f, "  x*y - c*(y*x)       rewritten in {n}")?,
        }
        writeln!(f, "  fma                 {}", if self.fused > 0 { "fused" } else { "not fused" })?;
        match self.comparisons_wrong {
            0 => writeln!(f, "  comparisons         IEEE")?,
            n => writeln!(f, "  comparisons         {n} not IEEE")?,
        }
        match self.folded {
            0 => writeln!(f, "  other operations    as written")?,
            n => writeln!(f, "  other operations    not as written in {n}")?,
        }
        let kept = |wrong: usize, of: usize| match wrong {
            0 => format!("kept, all {of}"),
            n => format!("{n} of {of} taken for 0"),
        };
        writeln!(f, "  subnormal results   {}", kept(self.subnormals_wrong, self.subnormals))?;
        writeln!(f, "  subnormal operands  {}", kept(self.subnormal_operands_wrong, self.subnormal_operands))?;
        match self.subnormal_comparisons_wrong {
            0 => writeln!(f, "  subnormals compared as IEEE says")?,
            n => writeln!(f, "  subnormals compared {n} not as IEEE says")?,
        }
        match self.subnormal_bits_wrong {
            0 => writeln!(f, "  subnormals' bits    kept")?,
            n => writeln!(f, "  subnormals' bits    lost in {n}")?,
        }
        writeln!(f, "  verdict             {}", self.arithmetic())?;
        write!(
            f,
            "  fast                {}",
            match self.arithmetic() {
                Arithmetic::Ieee => "the CPU's bits",
                Arithmetic::IeeeButForSubnormals =>
                    "the CPU's bits where no number is subnormal; scenes of extremes go to the CPU",
                Arithmetic::NotIeee => "other bits than the CPU's; scenes of extremes go to the CPU",
            }
        )
    }
}

//! A fingerprint as people read it.

use std::fmt;

use super::Fingerprint;

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
            n => writeln!(f, "  comparisons         {n} not IEEE, of NaN or subnormals among them")?,
        }
        match self.subnormals_wrong {
            0 => writeln!(f, "  subnormals          kept, all {}", self.subnormals)?,
            n => writeln!(f, "  subnormals          {n} of {} not kept", self.subnormals)?,
        }
        write!(f, "  verdict             {}", if self.is_ieee() { "IEEE: the CPU's bits" } else { "not IEEE" })
    }
}

// The program that the editor shows first.

/** Glass with a rough surface: the hemispherical reflectance and a goniometer's scan. */
export const PROGRAM = `; Rough glass: a goniometer's scan at two angles of incidence
MODEL = Facet_BRDF_Model

VARIABLES:
  deg0   = atan(1)/45
  thetai = 30     ; degrees
  thetas = 30
  incidentangle = thetai*deg0
  incidentpol   = (1,0,0,0)
  rotation      = 0
  differential  = (0.5*deg0)^2
  minsamples    = 50

  #lambda    = 0.55
  $substrate = (1.5,0)
  #type      = 0
  $sdf       = Gaussian_Slope_Distribution_Function
  #sdf.s     = 0.2
END

VARY:
  FOR thetai FROM 30 TO 60 BY 30
  FOR thetas FROM 0 TO 80 BY 2
END

INTEGRALS:
  I = CIRCLE  CENTER = (thetas*deg0,0)  ALPHA = 2*deg0  POL = (1,0,0,0)  END
  Q = CIRCLE  CENTER = (thetas*deg0,0)  ALPHA = 2*deg0  POL = (0,1,0,0)  END
END

OUTPUTS:
  1 signal=I
  2 polarization=Q/I
END

FILES:
  results = glass.dat
  listing = glass.lst
  samples = glass.txt
END
`;

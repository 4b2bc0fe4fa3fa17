"""Sources that several results cite."""

CRASSIDIS = "Crassidis and Markley 2003 (doi 10.2514/2.5102)"
HIDALGO = "Hidalgo et al. 2012 (doi 10.3390/s120202219)"
VAN_LOAN = "Van Loan 1978 (doi 10.1109/TAC.1978.1101743)"
